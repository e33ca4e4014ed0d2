//! How far a render is, told while it goes on.

use crate::render::Progress;
use crate::scene::RenderSettings;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::IsTerminal;
use std::time::Instant;

/// A bar on the terminal: of samples, of time, or of a falling error.
pub struct ProgressDisplay {
    bar: ProgressBar,
    of: Measure,
    started: Instant,
}

/// What a bar shows.
enum Measure {
    Samples,
    Time,
    Error(f64),
}

impl ProgressDisplay {
    /// Starts the display of a render that has just begun.
    pub fn new(quiet: bool, settings: &RenderSettings, started: Instant) -> Self {
        let (of, template) = match (settings.deadline, settings.target_error) {
            (_, Some(target)) => (Measure::Error(target), "{spinner} {elapsed}, {msg}"),
            (Some(_), None) => (Measure::Time, "{bar:32} {pos}/{len} s, {msg}"),
            (None, None) => (Measure::Samples, "{bar:32} {pos}/{len} samples per pixel, {msg}, {eta} left"),
        };
        let length = match (&of, settings.deadline) {
            (Measure::Time, Some(deadline)) => deadline.saturating_duration_since(started).as_secs(),
            _ => settings.samples_per_pixel,
        };
        let bar = match quiet || !std::io::stderr().is_terminal() {
            true => ProgressBar::hidden(),
            false => ProgressBar::with_draw_target(Some(length), ProgressDrawTarget::stderr()),
        };
        if let Ok(style) = ProgressStyle::with_template(template) {
            bar.set_style(style);
        }
        Self { bar, of, started }
    }

    /// Shows how far it is.
    pub fn show(&self, progress: &Progress) {
        let elapsed = self.started.elapsed();
        let speed = format!("{:.1} Mrays/s", progress.rays as f64 / elapsed.as_secs_f64() / 1e6);
        match self.of {
            Measure::Samples => {
                self.bar.set_position(progress.samples);
                self.bar.set_message(speed);
            }
            Measure::Time => {
                self.bar.set_position(elapsed.as_secs());
                self.bar.set_message(format!("{} samples per pixel, {speed}", progress.samples));
            }
            Measure::Error(target) => {
                let bound = progress.error_bound.map_or("unknown".to_owned(), |bound| format!("at most {bound:.2e}"));
                let samples = progress.samples;
                self.bar
                    .set_message(format!("{samples} samples per pixel, {speed}, relMSE {bound}, to be {target:.2e}"));
                self.bar.tick();
            }
        }
    }

    /// Takes the bar away.
    pub fn finish(&self) {
        self.bar.finish_and_clear();
    }
}
