//! Metrics of pictures.

use super::{Answer, Function, read};
use abbe::metrics::{self, Displayed, Pair, Pixel, stats};
use serde_json::{Value, json};

/// By name.
pub const FUNCTIONS: &[(&str, Function)] = &[
    ("relative_metrics", relative),
    ("displayed_metrics", displayed),
    ("flip_map", flip_map),
    ("bias", bias),
    ("student_t_quantile", student_t),
    ("quantile", quantile),
];

/// Width, picture, reference.
type Pictures = (u32, Vec<Pixel>, Vec<Pixel>);

/// relMSE, trimmed relMSE, MAPE, SMAPE.
fn relative(argument: &Value) -> Answer {
    let (width, test, reference): Pictures = read(argument)?;
    let pair = Pair::new(width, &test, &reference, None)?;
    let relmse = [metrics::relative_mse(&pair), metrics::trimmed_relative_mse(&pair)];
    Ok(json!([relmse[0], relmse[1], metrics::mape(&pair), metrics::smape(&pair)]))
}

/// PSNR; ΔE 2000: mean, 95 %, largest; of pictures in XYZ and a factor of exposure.
fn displayed(argument: &Value) -> Answer {
    let (width, test, reference, exposure): (u32, Vec<Pixel>, Vec<Pixel>, f64) = read(argument)?;
    let pair = Pair::new(width, &test, &reference, None)?;
    let [test, reference] = [&test, &reference].map(|xyz| Displayed::new(xyz, exposure));
    let color = metrics::color_difference(&pair, &metrics::color_difference_map(&test, &reference));
    Ok(json!([metrics::psnr(&pair, &test, &reference), color.mean, color.percentile_95, color.max]))
}

/// FLIP of pictures in XYZ: every pixel. The last argument is the number of pixels per degree.
fn flip_map(argument: &Value) -> Answer {
    let (width, test, reference, pixels_per_degree): (u32, Vec<Pixel>, Vec<Pixel>, f64) = read(argument)?;
    let [test, reference] = [&test, &reference].map(|xyz| Displayed::new(xyz, 1.0));
    Ok(json!(metrics::flip_map(width as usize, &test, &reference, pixels_per_degree)))
}

/// Mean and half width of each channel.
fn bias(argument: &Value) -> Answer {
    let (width, test, reference): Pictures = read(argument)?;
    let pair = Pair::new(width, &test, &reference, None)?;
    Ok(json!(metrics::bias(&pair).map(|b| [b.mean, b.half_width])))
}

fn student_t(argument: &Value) -> Answer {
    let (p, freedom): (f64, f64) = read(argument)?;
    Ok(json!(stats::student_t_quantile(p, freedom)))
}

fn quantile(argument: &Value) -> Answer {
    let (values, p): (Vec<f64>, f64) = read(argument)?;
    Ok(json!(stats::quantile(&values, p)))
}
