//! The kernels that every path runs through, one thread: `cargo bench --bench kernels [FILTER]`.
//!
//! Each is timed over a few hundred different arguments, so that no branch is always taken alike; criterion's "elem/s" are
//! calls a second.

use abbe::bsdf::{
    Branching, Bsdf, Carried, Conductor, Dielectric, Diffuse, Incidence, Indices, Lanes, Mirror, NEVER, Parting,
};
use abbe::color::{Observer, illuminant};
use abbe::film::{CameraTile, Film, Filter, SamplePlace, Sensor, Splats, value};
use abbe::geometry::Frame;
use abbe::optics::ior::IndexOfRefraction;
use abbe::optics::{fresnel_conductor, refract};
use abbe::sampling::{Sobol, cosine_hemisphere, uniform_sphere};
use abbe::spectrum::{SampledSpectrum, SpectrumTable, WavelengthDensity, Wavelengths};
use criterion::{BenchmarkGroup, Criterion, Throughput, criterion_group, criterion_main, measurement::WallTime};
use glam::{DVec3, Vec3};
use std::hint::black_box;

/// Arguments of each kernel.
const COUNT: usize = 512;

/// Points of a scrambled sequence, the same in every run.
fn points() -> Vec<[f32; 8]> {
    let sobol = Sobol::new(7);
    (0..COUNT as u64).map(|i| sobol.group(i, 3)).collect()
}

/// D65 at 1 nm, as the renderer has its spectra.
fn daylight() -> (Vec<f64>, Vec<f64>) {
    let d65 = illuminant::d65();
    let nm: Vec<f64> = (360..=830).map(f64::from).collect();
    let values = nm.iter().map(|&l| d65.eval(l)).collect();
    (nm, values)
}

fn density() -> WavelengthDensity {
    let (nm, light) = daylight();
    let observer = Observer::cie_1931_2deg();
    let sensitivity: Vec<f64> = nm.iter().map(|&l| observer.eval(l).element_sum()).collect();
    WavelengthDensity::new(&nm, &light, &sensitivity)
}

fn wavelengths() -> Vec<Wavelengths> {
    let density = density();
    points().iter().map(|u| density.sample(u[2])).collect()
}

/// Times `kernel` over all arguments.
fn each<T, R>(group: &mut BenchmarkGroup<WallTime>, name: &str, arguments: &[T], mut kernel: impl FnMut(&T) -> R) {
    group.throughput(Throughput::Elements(arguments.len() as u64));
    group.bench_function(name, |bencher| {
        bencher.iter(|| {
            for argument in arguments {
                black_box(kernel(black_box(argument)));
            }
        });
    });
}

fn sampling(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("sampling");
    let sobol = Sobol::new(11);
    let indices: Vec<u64> = (0..COUNT as u64).collect();
    each(&mut group, "sobol, 8 dimensions", &indices, |&i| sobol.group(i, (i % 5) as u32));
    let (density, points) = (density(), points());
    each(&mut group, "8 wavelengths and densities", &points, |u| density.sample(u[0]));
    each(&mut group, "cosine hemisphere", &points, |u| cosine_hemisphere([u[0], u[1]]));
    each(&mut group, "sphere", &points, |u| uniform_sphere([u[0], u[1]]));
    let filter = Filter::blackman_harris(1.5);
    each(&mut group, "Blackman-Harris filter", &points, |u| filter.sample([u[0], u[1]]));
    group.finish();
}

fn spectra(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("spectra");
    let wavelengths = wavelengths();
    let (nm, values) = daylight();
    let even = SpectrumTable::new(&nm, &values);
    let shifted: Vec<f64> = nm.iter().map(|l| l + 0.25).collect();
    let uneven = SpectrumTable::new(&shifted, &values);
    each(&mut group, "table at 1 nm, 8 lanes", &wavelengths, |w| even.sample(w));
    each(&mut group, "table with uneven knots, 8 lanes", &wavelengths, |w| uneven.sample(w));
    let sellmeier = IndexOfRefraction::sellmeier(
        &[1.03961212, 0.231792344, 1.01046945],
        &[0.00600069867, 0.0200179144, 103.560653],
    );
    let sellmeier = sellmeier.expect("the formula of N-BK7");
    each(&mut group, "Sellmeier index, 8 lanes", &wavelengths, |w| w.lambda_nm.map(|l| sellmeier.eval(f64::from(l))));
    let observer = Observer::cie_1931_2deg();
    let matching: Vec<[f64; 3]> = nm.iter().map(|&l| observer.eval(l).to_array()).collect();
    let sensor = Sensor::new(360.0, &matching);
    let mut weights = Vec::new();
    each(&mut group, "XYZ of 8 lanes", &wavelengths, |w| {
        sensor.weights(w, &mut weights);
        let radiance = even.sample(w);
        [0, 1, 2].map(|c| value(weights[c], radiance))
    });
    group.finish();
}

fn optics(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("optics");
    let points = points();
    let cosine = |u: &[f32; 8]| f64::from(u[0]);
    each(&mut group, "Fresnel and Snell into glass", &points, |u| refract(cosine(u), 1.0, 1.5168));
    each(&mut group, "Fresnel and Snell out of glass", &points, |u| refract(cosine(u), 1.5168, 1.0));
    each(&mut group, "Fresnel of a metal", &points, |u| fresnel_conductor(cosine(u), 1.0, 0.2 + f64::from(u[1]), 3.0));
    each(&mut group, "refracted direction", &points, |u| {
        let direction = -cosine_hemisphere([u[0], u[1]]).as_dvec3();
        let cos = -direction.z;
        refract(cos, 1.0, 1.5168).map(|r| r.direction(direction, DVec3::Z, cos, 1.0, 1.5168))
    });
    group.finish();
}

fn bsdfs(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("bsdf");
    let points = points();
    let frame = Frame { geometric: DVec3::Z, shading: Vec3::Z };
    let grey = SampledSpectrum::splat(0.5);
    let branching = Branching { parting: Parting::Ways(2), least_share: NEVER };
    let carried = Carried::new(0, branching);
    let kinds = [
        ("diffuse", Bsdf::Diffuse(Diffuse { reflectance: grey })),
        ("mirror", Bsdf::Mirror(Mirror { reflectance: grey })),
        ("conductor", Bsdf::Conductor(Conductor { eta: grey, k: SampledSpectrum::splat(3.0), eta_outside: [1.0; 8] })),
    ];
    for (name, bsdf) in kinds {
        each(&mut group, &format!("{name}: sample"), &points, |u| {
            bsdf.sample(&frame, cosine_hemisphere([u[0], u[1]]), &carried, [u[2], u[3]], u[4])
        });
    }
    let (_, diffuse) = kinds[0];
    each(&mut group, "diffuse: value and density", &points, |u| {
        let [wo, wi] = [[u[0], u[1]], [u[2], u[3]]].map(cosine_hemisphere);
        diffuse.evaluate(&frame, wo, wi)
    });
    let glass = Indices { eta: std::array::from_fn(|k| 1.53 - 0.002 * k as f64), dispersive: true };
    let plain = Indices { eta: [1.5168; 8], dispersive: false };
    for (name, to) in [("dispersive", glass), ("constant", plain)] {
        let boundary = Dielectric { from: Indices::AIR, to };
        each(&mut group, &format!("dielectric, {name}: choice and direction"), &points, |u| {
            let incidence = Incidence::new(-cosine_hemisphere([u[0], u[1]]), DVec3::Z);
            let sample = boundary.divide(&incidence, Lanes::Shared, grey).choose(u[2]);
            let direction =
                if sample.refracted { boundary.refracted(&incidence, 3) } else { Some(incidence.reflected()) };
            (sample.weight, direction)
        });
    }
    group.finish();
}

fn film(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("film");
    let points = points();
    let sensor = Sensor::of_observer(Observer::cie_1931_2deg());
    let wavelengths = Wavelengths { lambda_nm: std::array::from_fn(|k| 400.0 + 40.0 * k as f32), pdf: [0.003; 8] };
    for (name, filter) in [("box", Filter::boxed(0.5)), ("Blackman-Harris", Filter::blackman_harris(1.5))] {
        let mut tile = CameraTile::new([0, 0], [16, 16], filter.reach(), sensor.channels());
        each(&mut group, &format!("camera sample under {name}"), &points, |u| {
            let pixel = [u[5], u[6]].map(|u| (16.0 * u) as i32);
            let (offset, replicate) = (Some([u[0], u[7]]), (u[1] * 2.0) as usize);
            let place = SamplePlace { pixel, offset, replicate, weight: 1.0 };
            tile.add(&sensor, &filter, &place, &wavelengths, SampledSpectrum::splat(u[2]));
        });
    }
    let mut film = Film::new(64, 64, 1.0);
    let of_point = |u: &[f32; 8]| ((u[0] * 4096.0) as u32, [u[2], u[3], u[4]].map(f64::from));
    let splats = Splats::of(&points.iter().map(of_point).collect::<Vec<_>>());
    group.throughput(Throughput::Elements(COUNT as u64));
    group.bench_function("splats of light paths", |bencher| {
        bencher.iter(|| film.add_splats(1, 1, 1.0, black_box(&splats)));
    });
    let filter = Filter::blackman_harris(1.5);
    each(&mut group, "pixels of a splat under Blackman-Harris", &points, |u| {
        let mut sum = 0.0;
        filter.splat([u[0] * 60.0 + 2.0, u[1] * 60.0 + 2.0], 64, 64, |_, _, weight| sum += weight);
        sum
    });
    group.finish();
}

criterion_group! {
    name = kernels;
    config = Criterion::default().sample_size(20).warm_up_time(std::time::Duration::from_millis(300))
        .measurement_time(std::time::Duration::from_secs(1));
    targets = sampling, spectra, optics, bsdfs, film
}
criterion_main!(kernels);
