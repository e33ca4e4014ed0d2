//! What a render tells of itself: lines for people with `-v`, one JSON object with `--json`.

use super::write::Written;
use crate::Result;
use crate::cli::{process, write_data};
use crate::render::{Phase, Profile, Rendering, Statistics};
use crate::scene::Compiled;
use serde_json::{Value, json};
use std::io::IsTerminal;
use std::time::Duration;

/// Tells of a scene that has been compiled.
pub fn describe(compiled: &Compiled, elapsed: Duration) {
    let scene = &compiled.scene;
    let yes = |b: bool| if b { "yes" } else { "no" };
    eprintln!(
        "compiled in {:.2} s: {} objects, {} lights; dispersion: {}, interiors: {}; integrator: {:?}",
        elapsed.as_secs_f64(),
        scene.objects.len(),
        scene.lights.len(),
        yes(scene.features.dispersion),
        yes(scene.features.interiors),
        compiled.render.integrator,
    );
}

/// Tells how a render went.
pub fn report(written: &Written, rendering: &Rendering, seconds: f64, writing: Duration) -> Result<()> {
    let Rendering { film, statistics, .. } = rendering;
    if film.non_finite_samples > 0 {
        eprintln!("warning: {} samples were not finite and have been left out", film.non_finite_samples);
    }
    let args = written.args;
    if let (Some(target), false) = (args.target_error, args.quiet)
        && !reaches(statistics, target)
    {
        let bound = statistics.error_bound.map_or("unknown".to_owned(), |bound| format!("at most {bound:.2e}"));
        eprintln!("warning: the target error {target:.2e} has not been reached: relMSE {bound}");
    }
    if args.verbose {
        tell(rendering);
        tell_profile(rendering, written.compiling, writing);
    }
    if args.json {
        let value = to_json(written, rendering, seconds, writing);
        write_data(&mut std::io::stdout().lock(), format!("{value}\n").as_bytes())?;
    } else if !args.quiet && std::io::stderr().is_terminal() {
        let names: Vec<String> = written.outputs.iter().map(|p| p.display().to_string()).collect();
        eprintln!("{} in {seconds:.1} s", names.join(", "));
    }
    Ok(())
}

fn reaches(statistics: &Statistics, target: f64) -> bool {
    statistics.error_bound.is_some_and(|bound| bound < target)
}

fn tell(rendering: &Rendering) {
    let Rendering { film, statistics, .. } = rendering;
    eprintln!("{}", statistics.decisions);
    let cpu = process::cpu_seconds().unwrap_or(f64::NAN);
    let light_paths = statistics.light_paths + statistics.photon_paths;
    let paths = (statistics.camera_paths + light_paths) as f64;
    let told = |error: Option<f64>| error.map_or("unknown".to_owned(), |e| format!("{e:.2e}"));
    eprintln!(
        "{} samples per pixel: {} camera paths, {light_paths} light paths, {} of them for merging, {:.2} rays a path, {:.3} µs \
         of CPU a path, {} rays left glass they had not entered; estimated relMSE {}, with 95 % confidence below {}",
        statistics.samples,
        statistics.camera_paths,
        statistics.photon_paths,
        statistics.counters.rays as f64 / paths,
        cpu / paths * 1e6,
        statistics.counters.medium_underflows,
        told(film.estimated_relative_mse()),
        told(statistics.error_bound),
    );
}

/// Prints the time of each phase, and the part of it that went into finding intersections.
fn tell_profile(rendering: &Rendering, compiling: Duration, writing: Duration) {
    let Rendering { profile, statistics, .. } = rendering;
    let phases = phases(profile, compiling, writing);
    let total: f64 = phases.iter().map(|(_, seconds, _)| seconds).sum();
    let told: Vec<String> = phases
        .iter()
        .filter(|(_, seconds, _)| *seconds > 0.0005 * total)
        .map(|(name, seconds, rays)| match *rays {
            0 => format!("{name} {seconds:.2} s"),
            _ => format!("{name} {seconds:.2} s ({:.2} Mrays)", *rays as f64 / 1e6),
        })
        .collect();
    let counters = &statistics.counters;
    eprintln!(
        "time: {}; {:.0} % of the rays are shadow rays; lane occupancy {:.2}; a ray takes {:.0} ns to trace{}",
        told.join(", "),
        100.0 * counters.shadow_rays as f64 / counters.rays.max(1) as f64,
        counters.lane_occupancy(),
        profile.intersections.seconds_per_ray() * 1e9,
        tracing_share(rendering).map_or(String::new(), |share| format!(", {:.0} % of the CPU time", 100.0 * share)),
    );
}

/// Names, seconds and rays of all phases of the program.
fn phases(profile: &Profile, compiling: Duration, writing: Duration) -> Vec<(&'static str, f64, u64)> {
    let of_phase =
        |phase: Phase| (phase.name(), profile.phases[phase as usize].as_secs_f64(), profile.rays[phase as usize]);
    let mut phases = vec![("compiling", compiling.as_secs_f64(), 0)];
    phases.extend(Phase::ALL.map(of_phase));
    phases.push(("writing", writing.as_secs_f64(), 0));
    phases
}

/// Share of the processor time that went into finding intersections, from the rays that were timed.
fn tracing_share(rendering: &Rendering) -> Option<f64> {
    let seconds = rendering.profile.intersections.seconds_per_ray() * rendering.statistics.counters.rays as f64;
    process::cpu_seconds().filter(|cpu| *cpu > 0.0).map(|cpu| seconds / cpu)
}

fn to_json(written: &Written, rendering: &Rendering, seconds: f64, writing: Duration) -> Value {
    let Rendering { film, statistics, profile } = rendering;
    let decisions = &statistics.decisions;
    let phases: serde_json::Map<String, Value> = phases(profile, written.compiling, writing)
        .into_iter()
        .map(|(name, seconds, rays)| (name.to_owned(), json!({ "seconds": seconds, "rays": rays })))
        .collect();
    json!({
        "seconds": seconds,
        "cpu_seconds": process::cpu_seconds(),
        "samples_per_pixel": statistics.samples,
        "width": film.width(),
        "height": film.height(),
        "camera_paths": statistics.camera_paths,
        "light_paths": statistics.light_paths,
        "photon_paths": statistics.photon_paths,
        "plan": {
            "camera_ways": decisions.camera_ways,
            "light_ways": decisions.light_ways,
            "light_paths_per_camera_path": decisions.light_paths_per_camera_path,
            "merge_passes_per_sample": decisions.merge_passes_per_sample,
            "photon_paths_per_pass": decisions.photon_paths_per_pass,
            "pilot_rays": decisions.pilot_rays,
        },
        "adaptive": written.compiled.render.adaptive,
        "rays": statistics.counters.rays,
        "shadow_rays": statistics.counters.shadow_rays,
        "lane_occupancy": statistics.counters.lane_occupancy(),
        "medium_underflows": statistics.counters.medium_underflows,
        "estimated_relative_mse": film.estimated_relative_mse(),
        "relative_mse_bound": statistics.error_bound,
        "target_reached": written.args.target_error.map(|target| reaches(statistics, target)),
        "non_finite_samples": film.non_finite_samples,
        "profile": {
            "phases": phases,
            "seconds_per_ray": profile.intersections.seconds_per_ray(),
            "tracing_share_of_cpu": tracing_share(rendering),
        },
        "peak_memory_bytes": process::peak_memory_bytes(),
        "outputs": written.outputs,
    })
}
