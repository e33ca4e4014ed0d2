//! The summary of a benchmark as a table for people.

use super::summary::{Level, Reached};
use super::{SceneReport, Session, VariantReport};

/// The columns of the summary: head, and text for each variant.
pub fn columns(session: &Session, report: &SceneReport) -> Vec<(String, Vec<String>)> {
    let of = |value: &dyn Fn(&VariantReport) -> String| report.variants.iter().map(value).collect::<Vec<_>>();
    let mut columns = vec![("variant".to_owned(), of(&|v| v.variant.name.clone()))];
    for (i, target) in session.targets.iter().enumerate() {
        let text = of(&|v| told(&v.summary.reached[i].1));
        columns.push((format!("CPU s to relMSE {target}"), text));
        if report.variants.len() > 1 {
            columns.push(("speed".to_owned(), of(&|v| speed(&report.variants[0], v, i))));
        }
    }
    let optional = |value: Option<f64>| value.map_or("–".to_owned(), number);
    columns.push(("efficiency 1/(relMSE·CPU s)".into(), of(&|v| optional(v.summary.efficiency))));
    let slope = |s: Option<(f64, f64)>| {
        s.map_or("–".to_owned(), |(s, error)| format!("{s:+.2} ± {error:.2}").replace(" ± NaN", ""))
    };
    columns.push(("slope".into(), of(&|v| slope(v.summary.slope))));
    columns.push(("fixed CPU s".into(), of(&|v| optional(v.summary.cost.map(|cost| cost.fixed)))));
    columns.push(("CPU ms/spp".into(), of(&|v| optional(v.summary.cost.map(|cost| cost.per_sample * 1e3)))));
    let rays = |v: &VariantReport| v.levels.last().and_then(Level::rays_per_cpu_second).map(|rays| rays * 1e-6);
    columns.push(("Mrays/CPU s".into(), of(&|v| optional(rays(v)))));
    let shadow = |level: &Level| {
        let [shadow, all] = [level.rays_of_kind(|kinds| kinds.shadow)?, level.rays_per_cpu_second()?];
        Some(100.0 * shadow / all)
    };
    let lanes = |level: &Level| level.mean_of_kinds(|kinds| 100.0 * kinds.lane_occupancy);
    let percent = |v: &VariantReport, value: &dyn Fn(&Level) -> Option<f64>| {
        v.levels.last().and_then(value).map(|p| format!("{p:.0} %"))
    };
    columns.push(("shadow rays".into(), of(&|v| percent(v, &shadow).unwrap_or("–".into()))));
    columns.push(("lanes in use".into(), of(&|v| percent(v, &lanes).unwrap_or("–".into()))));
    let memory = |v: &VariantReport| v.levels.last().and_then(Level::peak_memory_bytes).map(|b| b as f64 / 1048576.0);
    columns.push(("peak MiB".into(), of(&|v| memory(v).map_or("–".into(), |m| format!("{m:.0}")))));
    columns
}

/// How long a target takes.
fn told(reached: &Reached) -> String {
    match reached {
        Reached::After { cpu_seconds, low, high } => {
            let high = if high.is_finite() { number(*high) } else { "?".into() };
            format!("{} ({}–{high})", number(*cpu_seconds), number(*low))
        }
        Reached::AtOnce(cpu) => format!("< {}", number(*cpu)),
        Reached::NotIn(cpu) => format!("not reached in {} CPU s", number(*cpu)),
    }
}

/// How many times faster than the first variant, where both reach the target.
fn speed(first: &VariantReport, other: &VariantReport, target: usize) -> String {
    match (first.summary.reached[target].1, other.summary.reached[target].1) {
        (Reached::After { cpu_seconds: a, .. }, Reached::After { cpu_seconds: b, .. }) => format!("{:.2} x", a / b),
        (Reached::NotIn(a), Reached::After { cpu_seconds: b, .. }) => format!("> {:.2} x", a / b),
        (Reached::After { cpu_seconds: a, .. }, Reached::NotIn(b)) => format!("< {:.2} x", a / b),
        _ => "–".into(),
    }
}

/// Three significant digits.
pub fn number(value: f64) -> String {
    match value.abs() {
        0.0 => "0".into(),
        v if !(1e-3..1e5).contains(&v) => format!("{value:.2e}"),
        v if v >= 100.0 => format!("{value:.0}"),
        v if v >= 10.0 => format!("{value:.1}"),
        v if v >= 1.0 => format!("{value:.2}"),
        v if v >= 0.1 => format!("{value:.3}"),
        _ => format!("{value:.4}"),
    }
}

/// A table for each scene, for people.
pub fn to_table(session: &Session, reports: &[SceneReport]) -> String {
    let mut text = String::new();
    for report in reports {
        text += &format!("{}, {}x{}: {}\n", report.name, report.width, report.height, report.reference.told());
        let columns = columns(session, report);
        let width = |(head, cells): &(String, Vec<String>)| {
            cells.iter().chain([head]).map(|cell| cell.chars().count()).max().unwrap_or(0)
        };
        let widths: Vec<usize> = columns.iter().map(width).collect();
        let line = |cells: Vec<&str>| {
            let padded = cells.iter().zip(&widths).map(|(cell, &width)| format!("{cell:width$}"));
            padded.collect::<Vec<_>>().join("  ").trim_end().to_owned() + "\n"
        };
        text += &line(columns.iter().map(|(head, _)| head.as_str()).collect());
        for i in 0..report.variants.len() {
            text += &line(columns.iter().map(|(_, cells)| cells[i].as_str()).collect());
        }
        text += "\n";
    }
    text + &format!("{}\n", session.args.output.join("bench.html").display())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn three_significant_digits() {
        let numbers = [0.0, 0.01234, 1.2345, 12.345, 123.45, 1.2e-9, 7e9].map(number);
        assert_eq!(numbers, ["0", "0.0123", "1.23", "12.3", "123", "1.20e-9", "7.00e9"]);
    }
}
