//! What a benchmark leaves behind: tables for people and for programs.

use super::summary::{Level, Reached};
use super::variant::Kind;
use super::{SceneReport, Session, VariantReport, html};
use crate::Result;
use crate::io::output::write_atomically;
use crate::render::Phase;
use serde_json::{Value, json};

/// Writes bench.csv, bench.json, bench.html and a plot of each scene.
pub fn write_files(session: &Session, reports: &[SceneReport]) -> Result<()> {
    let folder = &session.args.output;
    write_atomically(&folder.join("bench.csv"), to_csv(reports).as_bytes())?;
    write_atomically(&folder.join("bench.json"), format!("{:#}\n", to_json(session, reports)).as_bytes())?;
    write_atomically(&folder.join("bench.html"), html::page(session, reports)?.as_bytes())?;
    for (report, name) in reports.iter().zip(plot_names(reports.iter().map(|report| report.name.as_str()))) {
        if let Some(svg) = html::plot_file(session, report) {
            write_atomically(&folder.join(name), svg.as_bytes())?;
        }
    }
    Ok(())
}

/// SCENE.svg, and SCENE-2.svg for a second scene of that name.
fn plot_names<'a>(scenes: impl Iterator<Item = &'a str>) -> Vec<String> {
    let mut names: Vec<String> = Vec::new();
    for scene in scenes {
        let numbered = (2..).map(|number| format!("{scene}-{number}.svg"));
        let free = std::iter::once(format!("{scene}.svg")).chain(numbered).find(|name| !names.contains(name));
        names.extend(free);
    }
    names
}

/// One line a run.
fn to_csv(reports: &[SceneReport]) -> String {
    let mut text = "scene,variant,samples_per_pixel,replicate,seed,wall_seconds,cpu_seconds,relmse,relmse_trimmed,\
                    reference_relmse,rays,shadow_rays,lane_occupancy,peak_memory_bytes,non_finite_pixels\n"
        .to_owned();
    for report in reports {
        for v in &report.variants {
            for (level, (replicate, run)) in
                v.levels.iter().flat_map(|l| l.runs.iter().enumerate().map(move |r| (l, r)))
            {
                let optional = |value: Option<u64>| value.map_or(String::new(), |v| v.to_string());
                let fields = [
                    quoted(&report.name),
                    quoted(&v.variant.name),
                    level.spp.to_string(),
                    replicate.to_string(),
                    run.seed.to_string(),
                    run.wall_seconds.to_string(),
                    run.cpu_seconds.to_string(),
                    run.raw_relmse.to_string(),
                    run.trimmed_relmse.to_string(),
                    report.reference.own_relmse().to_string(),
                    optional(run.rays),
                    optional(run.kinds.map(|kinds| kinds.shadow)),
                    run.kinds.map_or(String::new(), |kinds| kinds.lane_occupancy.to_string()),
                    optional(run.peak_memory_bytes),
                    run.non_finite_pixels.to_string(),
                ];
                text += &(fields.join(",") + "\n");
            }
        }
    }
    text
}

/// A CSV field.
pub fn quoted(text: &str) -> String {
    let plain = !text.contains([',', '"', '\n', '\r']);
    if plain { text.to_owned() } else { format!("\"{}\"", text.replace('"', "\"\"")) }
}

/// Everything, as one object.
pub fn to_json(session: &Session, reports: &[SceneReport]) -> Value {
    let scenes: Vec<Value> = reports
        .iter()
        .map(|report| {
            json!({
                "scene": report.name, "width": report.width, "height": report.height,
                "compile_seconds": report.compile_seconds,
                "reference": report.reference.to_json(),
                "variants": report.variants.iter().map(variant_json).collect::<Vec<_>>(),
            })
        })
        .collect();
    json!({
        "program": crate::VERSION,
        "threads": session.pool.current_num_threads(),
        "replicates": session.args.replicates,
        "seed": session.args.seed,
        "cpu_clock": if session.clock.is_known() { "process" } else { "wall" },
        "targets": session.targets,
        "scenes": scenes,
    })
}

fn variant_json(report: &VariantReport) -> Value {
    let s = &report.summary;
    let command = match &report.variant.kind {
        Kind::Abbe { .. } => None,
        Kind::Command { template, .. } => Some(template),
    };
    let reached: Vec<Value> = s
        .reached
        .iter()
        .map(|(target, reached)| match reached {
            Reached::After { cpu_seconds, low, high } => {
                json!({ "relmse": target, "cpu_seconds": cpu_seconds, "low_95": low, "high_95": high })
            }
            Reached::AtOnce(cpu) => json!({ "relmse": target, "cpu_seconds": cpu, "by_the_smallest_budget": true }),
            Reached::NotIn(cpu) => json!({ "relmse": target, "cpu_seconds": Value::Null, "not_reached_in": cpu }),
        })
        .collect();
    json!({
        "name": report.variant.name,
        "command": command,
        "efficiency": s.efficiency,
        "slope": s.slope.map(|(slope, _)| slope),
        "slope_standard_error": s.slope.map(|(_, error)| error),
        "fixed_cpu_seconds": s.cost.map(|cost| cost.fixed),
        "cpu_seconds_per_sample": s.cost.map(|cost| cost.per_sample),
        "time_to_target": reached,
        "budgets": report.levels.iter().map(level_json).collect::<Vec<_>>(),
    })
}

fn level_json(level: &Level) -> Value {
    json!({
        "samples_per_pixel": level.spp,
        "relmse": level.relmse, "standard_error": level.standard_error, "percentile_90": level.percentile_90,
        "relmse_trimmed": level.trimmed_relmse, "systematic_relmse": level.systematic_relmse,
        "reference_too_noisy": level.too_good,
        "cpu_seconds": level.cpu_seconds, "wall_seconds": level.wall_seconds,
        "rays_per_cpu_second": level.rays_per_cpu_second(), "rays_per_cpu_second_by_kind": kinds_json(level),
        "lane_occupancy": level.mean_of_kinds(|kinds| kinds.lane_occupancy),
        "seconds_per_ray": level.mean_of_kinds(|kinds| kinds.seconds_per_ray),
        "peak_memory_bytes": level.peak_memory_bytes(),
        "runs": level.runs.iter().map(|run| json!({
            "seed": run.seed, "wall_seconds": run.wall_seconds, "cpu_seconds": run.cpu_seconds,
            "relmse_raw": run.raw_relmse, "relmse_trimmed": run.trimmed_relmse, "rays": run.rays,
            "peak_memory_bytes": run.peak_memory_bytes, "non_finite_pixels": run.non_finite_pixels,
        })).collect::<Vec<_>>(),
    })
}

/// Rays a second of processor time: by kind of work, where there are any, and shadow rays among them.
fn kinds_json(level: &Level) -> Value {
    let rays = |phase: Phase| level.rays_of_kind(|kinds| kinds.phases[phase as usize]).filter(|rays| *rays > 0.0);
    let named = |phase: Phase| Some((phase.name().to_owned(), json!(rays(phase)?)));
    let mut kinds: serde_json::Map<String, Value> = Phase::ALL.into_iter().filter_map(named).collect();
    kinds.extend(level.rays_of_kind(|kinds| kinds.shadow).map(|rays| ("shadow".to_owned(), json!(rays))));
    Value::Object(kinds)
}

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
    fn numbers_and_fields() {
        let numbers = [0.0, 0.01234, 1.2345, 12.345, 123.45, 1.2e-9, 7e9].map(number);
        assert_eq!(numbers, ["0", "0.0123", "1.23", "12.3", "123", "1.20e-9", "7.00e9"]);
        assert_eq!(plot_names(["a", "b", "a", "a"].into_iter()), ["a.svg", "b.svg", "a-2.svg", "a-3.svg"]);
        assert_eq!((quoted("a b"), quoted("a,\"b\"")), ("a b".into(), "\"a,\"\"b\"\"\"".into()));
    }
}
