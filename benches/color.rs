//! Speed of the colour library: `cargo bench --bench color`.
//!
//! One colour or spectrum an iteration; the colours are spread over the sRGB cube, so that easy and hard ones are averaged.

use abbe::color::upsample::{self, Coefficients, Method, Natural, Table};
use abbe::color::{Observer, RgbSpace, illuminant, srgb_decode, xyz_of_emission, xyz_of_reflectance};
use abbe::spectrum::Spectrum;
use criterion::{BatchSize, Criterion, criterion_group, criterion_main};
use std::hint::black_box;

const COLORS: usize = 64;

/// Colours spread evenly over encoded sRGB.
fn colors() -> Vec<[f64; 3]> {
    let component = |i: usize, step: f64| srgb_decode((0.5 + i as f64 * step).fract());
    (0..COLORS).map(|i| [0.819_172_5, 0.671_043_6, 0.549_700_5].map(|step| component(i, step))).collect()
}

/// Calls a function with one colour after the other.
fn each_color<T>(criterion: &mut Criterion, name: &str, mut function: impl FnMut([f64; 3]) -> T) {
    let colors = colors();
    let mut next = 0;
    criterion.bench_function(name, |bencher| {
        bencher.iter(|| {
            next = (next + 1) % COLORS;
            function(black_box(colors[next]))
        })
    });
}

fn spectrum_to_xyz(criterion: &mut Criterion) {
    let spectrum = upsample::reflectance([0.4, 0.2, 0.1], RgbSpace::srgb()).expect("a colour of sRGB");
    let (observer, d65) = (Observer::cie_1931_2deg(), illuminant::d65());
    criterion.bench_function("xyz/emission", |b| b.iter(|| xyz_of_emission(black_box(&spectrum), observer)));
    criterion.bench_function("xyz/reflectance under D65", |b| {
        b.iter(|| xyz_of_reflectance(black_box(&spectrum), d65, observer))
    });
}

fn upsamplers(criterion: &mut Criterion) {
    let srgb = RgbSpace::srgb();
    for method in Method::ALL {
        each_color(criterion, &format!("upsample/{}", method.name()), |rgb| {
            upsample::reflectance_by(method, rgb, srgb)
        });
    }
    each_color(criterion, "upsample/emission", |rgb| upsample::emission(rgb, srgb));
    let paints: Vec<Spectrum> =
        colors().iter().take(24).filter_map(|&rgb| upsample::reflectance(rgb, srgb).ok()).collect();
    let anchored = Natural::with_anchors(&paints).expect("reflectances of different colours");
    each_color(criterion, "upsample/natural, 24 anchors", |rgb| anchored.reflectance(rgb, srgb));
    let rec2020 = RgbSpace::by_name("rec2020").expect("a known space");
    criterion.bench_function("upsample/projected green of rec2020", |b| {
        b.iter(|| upsample::projected(black_box([0.0, 1.0, 0.0]), rec2020))
    });
}

fn textures(criterion: &mut Criterion) {
    let srgb = RgbSpace::srgb();
    let mut group = criterion.benchmark_group("texture");
    group.sample_size(10).bench_function("table", |b| b.iter_batched(|| srgb, Table::new, BatchSize::PerIteration));
    group.finish();
    let table = Table::srgb();
    for steps in [1, 2] {
        each_color(criterion, &format!("texture/coefficients, {steps} step(s)"), |rgb| table.coefficients(rgb, steps));
    }
    let texels: Vec<Coefficients> = colors().iter().filter_map(|&rgb| table.coefficients(rgb, 1).ok()).collect();
    let lambdas = [412.3_f32, 498.7, 561.2, 655.9];
    let mut next = 0;
    criterion.bench_function("texture/evaluation at 4 wavelengths", |b| {
        b.iter(|| {
            next = (next + 1) % texels.len();
            texels[next].sample(black_box(lambdas))
        })
    });
}

criterion_group!(benches, spectrum_to_xyz, upsamplers, textures);
criterion_main!(benches);
