//! Transfer functions.

use super::{Answer, Function, read};
use abbe::color::transfer::{Bt1886Display, HlgDisplay, pq_ootf, pq_ootf_inverse};
use abbe::color::{EncodedRgb, LinearRgb, Transfer};
use serde_json::{Value, json};

/// By name.
pub const FUNCTIONS: &[(&str, Function)] = &[
    ("transfer_encode", |argument| {
        let (name, linear): (String, f64) = read(argument)?;
        Ok(json!(Transfer::by_name(&name)?.encode(linear)))
    }),
    ("transfer_decode", |argument| {
        let (name, encoded): (String, f64) = read(argument)?;
        Ok(json!(Transfer::by_name(&name)?.decode(encoded)))
    }),
    ("transfer_round_trip", |argument| {
        let (name, linear): (String, f64) = read(argument)?;
        let transfer = Transfer::by_name(&name)?;
        Ok(json!(transfer.decode(transfer.encode(linear))))
    }),
    ("transfer_names", |_| Ok(json!(Transfer::names().collect::<Vec<_>>()))),
    ("pq_ootf", |argument| Ok(json!(pq_ootf(read(argument)?)))),
    ("pq_ootf_inverse", |argument| Ok(json!(pq_ootf_inverse(read(argument)?)))),
    ("hlg_display", hlg_display),
    ("hlg_display_inverse", hlg_display_inverse),
    ("bt1886_display", |argument| {
        let (black, white, signal) = read(argument)?;
        Ok(json!(Bt1886Display::new(black, white)?.eotf(signal)))
    }),
    ("bt1886_display_inverse", |argument| {
        let (black, white, luminance) = read(argument)?;
        Ok(json!(Bt1886Display::new(black, white)?.eotf_inverse(luminance)))
    }),
];

/// Black, peak, signal.
fn hlg_display(argument: &Value) -> Answer {
    let (black, peak, signal): (f64, f64, [f64; 3]) = read(argument)?;
    Ok(json!(HlgDisplay::new(black, peak)?.eotf(EncodedRgb::from(signal)).to_array()))
}

/// Black, peak, what is shown.
fn hlg_display_inverse(argument: &Value) -> Answer {
    let (black, peak, shown): (f64, f64, [f64; 3]) = read(argument)?;
    Ok(json!(HlgDisplay::new(black, peak)?.eotf_inverse(LinearRgb::from(shown)).to_array()))
}
