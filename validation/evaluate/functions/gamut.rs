//! Gamut mapping.

use super::{Function, read};
use abbe::color::gamut::{GamutMapper, GamutMethod, GamutReport};
use abbe::color::{LinearRgb, RgbSpace};
use serde_json::json;

/// By name.
pub const FUNCTIONS: &[(&str, Function)] = &[
    // Space, method, colour.
    ("gamut_map", |argument| {
        let (space, method, rgb): (String, String, [f64; 3]) = read(argument)?;
        let mapper = GamutMapper::new(RgbSpace::by_name(&space)?, GamutMethod::by_name(&method)?);
        Ok(json!(mapper.map(rgb.into()).to_array()))
    }),
    // Colours, shares and excesses of them.
    ("gamut_report", |argument| {
        let colors: Vec<[f64; 3]> = read(argument)?;
        let report: GamutReport = colors.into_iter().map(LinearRgb::from).collect();
        Ok(json!([
            report.outside as f64,
            report.below_zero as f64,
            report.above_one as f64,
            report.share_outside(),
            report.largest_excess,
            report.mean_excess()
        ]))
    }),
];
