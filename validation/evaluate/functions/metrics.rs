//! Metrics of pictures.

use super::{Answer, Function, read};
use abbe::Image;
use abbe::metrics::{self, Displayed, Pair, stats};
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
type Pictures = (u32, Vec<[f64; 3]>, Vec<[f64; 3]>);

fn pictures((width, test, reference): Pictures) -> abbe::Result<[Image; 2]> {
    Ok([Image::xyz(width, test)?, Image::xyz(width, reference)?])
}

/// relMSE, trimmed relMSE, MAPE, SMAPE.
fn relative(argument: &Value) -> Answer {
    let [test, reference] = pictures(read(argument)?)?;
    let pair = Pair::new(&test, &reference, None)?;
    let relmse = [metrics::relative_mse(&pair), metrics::trimmed_relative_mse(&pair)];
    Ok(json!([relmse[0], relmse[1], metrics::mape(&pair), metrics::smape(&pair)]))
}

/// PSNR; ΔE 2000: mean, 95 %, largest; of pictures in XYZ and a factor of exposure.
fn displayed(argument: &Value) -> Answer {
    let (width, test, reference, exposure) = read(argument)?;
    let [test, reference] = pictures((width, test, reference))?;
    let pair = Pair::new(&test, &reference, None)?;
    let [test, reference] = [&test, &reference].map(|xyz| Displayed::new(xyz, exposure));
    let color = metrics::color_difference(&pair, &metrics::color_difference_map(&test, &reference));
    Ok(json!([metrics::psnr(&pair, &test, &reference), color.mean, color.percentile_95, color.max]))
}

/// FLIP of pictures in XYZ: every pixel. The last argument is the number of pixels per degree.
fn flip_map(argument: &Value) -> Answer {
    let (width, test, reference, pixels_per_degree) = read(argument)?;
    let [test, reference] = pictures((width, test, reference))?.map(|xyz| Displayed::new(&xyz, 1.0));
    Ok(json!(metrics::flip_map(&test, &reference, pixels_per_degree).plane(0).collect::<Vec<f64>>()))
}

/// Mean and half width of each channel.
fn bias(argument: &Value) -> Answer {
    let [test, reference] = pictures(read(argument)?)?;
    let pair = Pair::new(&test, &reference, None)?;
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
