//! What `abbe compare` tells, and the limits it holds it against.

use super::{Channels, CompareArgs};
use crate::io::exr::Source;
use crate::metrics::{Bias, ColorDifference};
use crate::{Error, ErrorKind, Result};
use serde_json::{Value, json};
use std::fmt::Write;

/// Everything that is told of two pictures.
pub struct Report {
    /// What A and B were read from.
    pub sources: [Source; 2],
    /// Pixels in a row, and rows.
    pub size: [u32; 2],
    /// Pixels that count.
    pub pixels: usize,
    /// Pixels of A and B that are not finite.
    pub non_finite: [usize; 2],
    /// Factor of A.
    pub scale: f64,
    /// Stops.
    pub exposure_ev: f64,
    /// relMSE.
    pub relmse: f64,
    /// relMSE without the worst 0.1 %.
    pub trimmed_relmse: f64,
    /// MAPE, a fraction.
    pub mape: f64,
    /// SMAPE, a fraction.
    pub smape: f64,
    /// PSNR, dB.
    pub psnr: f64,
    /// ΔE 2000.
    pub color_difference: ColorDifference,
    /// Mean FLIP.
    pub flip: f64,
    /// Bias of each channel.
    pub bias: [Bias; 3],
}

/// A limit of one metric.
pub struct Threshold {
    metric: &'static str,
    value: f64,
}

const METRICS: [&str; 9] =
    ["relmse", "relmse-trimmed", "mape", "smape", "psnr", "delta-e", "delta-e-95", "delta-e-max", "flip"];

/// Parses `METRIC=NUMBER`, or a number, which is relMSE's.
pub fn threshold(text: &str) -> Result<Threshold> {
    let (name, number) = text.split_once('=').unwrap_or(("relmse", text));
    let metric = METRICS.into_iter().find(|metric| *metric == name).ok_or_else(|| {
        let message = format!("--threshold {text}: unknown metric {name:?}; expected one of {}", METRICS.join(", "));
        Error::new(ErrorKind::Usage, message).nearest(name, METRICS)
    })?;
    match number.parse() {
        Ok(value) if f64::is_finite(value) => Ok(Threshold { metric, value }),
        _ => Err(Error::new(ErrorKind::Usage, format!("--threshold {text}: expected a number, or METRIC=NUMBER"))),
    }
}

impl Threshold {
    /// What is wrong, if the picture is worse than allowed; NaN is.
    pub fn exceeded(&self, report: &Report) -> Option<String> {
        if report.non_finite[0] > 0 {
            return Some(format!("{} pixels are not finite", report.non_finite[0]));
        }
        let value = report.metric(self.metric);
        let (good, word) = match self.metric {
            "psnr" => (value >= self.value, "under"),
            _ => (value <= self.value, "over"),
        };
        (!good).then(|| format!("{} {value:.4} is {word} {}", self.metric, self.value))
    }
}

impl Report {
    fn metric(&self, name: &str) -> f64 {
        match name {
            "relmse" => self.relmse,
            "relmse-trimmed" => self.trimmed_relmse,
            "mape" => self.mape,
            "smape" => self.smape,
            "psnr" => self.psnr,
            "delta-e" => self.color_difference.mean,
            "delta-e-95" => self.color_difference.percentile_95,
            "delta-e-max" => self.color_difference.max,
            "flip" => self.flip,
            _ => f64::NAN,
        }
    }

    /// Writes the report as one JSON object; infinite values are null.
    pub fn to_json(&self, args: &CompareArgs, exceeded: &[String]) -> Value {
        let bias: Vec<Value> = names(args.channels)
            .into_iter()
            .zip(&self.bias)
            .map(|(name, b)| {
                json!({ "channel": name, "mean": b.mean, "half_width_95": b.half_width, "reference_mean": b.reference,
                        "significant": b.is_significant() })
            })
            .collect();
        let difference = self.color_difference;
        json!({
            "a": args.test, "b": args.reference,
            "sources": self.sources.map(told),
            "width": self.size[0], "height": self.size[1], "pixels": self.pixels,
            "non_finite_pixels": { "a": self.non_finite[0], "b": self.non_finite[1] },
            "channels": names(args.channels).concat().to_lowercase(),
            "scale": self.scale, "exposure_ev": self.exposure_ev,
            "relmse": self.relmse, "relmse_trimmed": self.trimmed_relmse, "mape": self.mape, "smape": self.smape,
            "psnr": self.psnr,
            "delta_e_2000": { "mean": difference.mean, "percentile_95": difference.percentile_95, "max": difference.max },
            "flip": self.flip,
            "bias": bias,
            "over_threshold": exceeded,
        })
    }

    /// Writes the report as lines for people.
    pub fn to_table(&self, args: &CompareArgs) -> String {
        let [from_a, from_b] = self.sources.map(told);
        let (a, b) = (args.test.display(), args.reference.display());
        let all = self.pixels as u64 == u64::from(self.size[0]) * u64::from(self.size[1]);
        let pixels = if all { String::new() } else { format!(", {} pixels of them", self.pixels) };
        let scaled = if self.scale == 1.0 { String::new() } else { format!(", A times {:.6}", self.scale) };
        let d = self.color_difference;
        let psnr =
            if self.psnr.is_finite() { format!("{:.2} dB", self.psnr) } else { "infinite: no difference".into() };
        let lines = [
            format!("{a} ({from_a}) against {b} ({from_b}), {}x{}{pixels}{scaled}", self.size[0], self.size[1]),
            String::new(),
            format!("relMSE   {}, without the worst 0.1 % {}", number(self.relmse), number(self.trimmed_relmse)),
            format!("MAPE     {}, SMAPE {}", percent(self.mape), percent(self.smape)),
            String::new(),
            format!("exposed by {:+.2} EV for a display:", self.exposure_ev),
            format!("PSNR     {psnr}"),
            format!("ΔE 2000  {:.3} mean, {:.3} at 95 %, {:.3} at most", d.mean, d.percentile_95, d.max),
            format!("FLIP     {:.4}", self.flip),
            String::new(),
            "bias of the mean, 95 % interval:".into(),
        ];
        let mut text = lines.join("\n") + "\n";
        for (name, bias) in names(args.channels).into_iter().zip(&self.bias) {
            // Writing to a String cannot fail.
            let _ = writeln!(text, "{name}        {}", interval(bias));
        }
        text
    }
}

fn interval(bias: &Bias) -> String {
    let relative = |v: f64| v / bias.reference.abs() * 100.0;
    let mark = if bias.is_significant() { "  (not 0)" } else { "" };
    let percents = match bias.reference {
        0.0 => String::new(),
        _ => format!(", {:+.3} % ± {:.3} %", relative(bias.mean), relative(bias.half_width)),
    };
    format!("{:+.4e} ± {:.1e}{percents}{mark}", bias.mean, bias.half_width)
}

fn number(value: f64) -> String {
    if value.is_finite() { format!("{value:.4e}") } else { "infinite".into() }
}

fn percent(fraction: f64) -> String {
    if fraction.is_finite() { format!("{:.3} %", fraction * 100.0) } else { "infinite".into() }
}

fn names(channels: Channels) -> [&'static str; 3] {
    match channels {
        Channels::Xyz => ["X", "Y", "Z"],
        Channels::Rgb => ["R", "G", "B"],
    }
}

fn told(source: Source) -> String {
    match source {
        Source::Xyz => "X, Y, Z".into(),
        Source::Rgb { chromaticities: true } => "R, G, B".into(),
        Source::Rgb { chromaticities: false } => "R, G, B taken as Rec. 709".into(),
        Source::Spectral { bands } => format!("{bands} spectral channels"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn thresholds() {
        let of = |text| threshold(text).map(|t| (t.metric, t.value));
        assert_eq!(of("0.01").unwrap(), ("relmse", 0.01));
        assert_eq!(of("psnr=40").unwrap(), ("psnr", 40.0));
        assert!(of("flap=1").unwrap_err().to_string().ends_with("did you mean \"flip\"?"));
        assert!(of("flip=x").is_err() && of("nan").is_err() && of("").is_err());
    }
}
