//! The files that a benchmark leaves behind.

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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_and_fields() {
        assert_eq!(plot_names(["a", "b", "a", "a"].into_iter()), ["a.svg", "b.svg", "a-2.svg", "a-3.svg"]);
        assert_eq!((quoted("a b"), quoted("a,\"b\"")), ("a b".into(), "\"a,\"\"b\"\"\"".into()));
    }
}
