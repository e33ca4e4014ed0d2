//! The round brilliant.

use super::super::codec::{Number, Object, Range};
use super::{LENGTH, ShapeDescription};
use crate::Result;

/// Cut of a round brilliant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BrilliantDescription {
    /// Girdle radius, metres.
    pub radius: f64,
    /// Table diameter as a fraction of the girdle's; 0.57 by default.
    pub table: f64,
    /// Angle of the crown mains to the girdle plane, degrees; 34.5 by default.
    pub crown_degrees: f64,
    /// Angle of the pavilion mains, degrees; 40.75 by default.
    pub pavilion_degrees: f64,
    /// Girdle thickness as a fraction of its diameter; 0.03 by default.
    pub girdle: f64,
    /// Star facet length: share of the way from table to girdle, in (0, 1); 0.5 by default.
    pub star: f64,
    /// Lower-half facet length: share of the way from girdle to culet, in (0, 1); 0.77 by default.
    pub lower_half: f64,
}

const ACUTE: Number = Number(Range::between(0.0, 90.0));
const SHARE: Number = Number(Range::between(0.0, 1.0));

#[rustfmt::skip] // one key a line
pub fn read(o: &mut Object) -> Result<ShapeDescription> {
    Ok(ShapeDescription::Brilliant(BrilliantDescription {
        radius: o.required("radius", LENGTH, "Girdle radius, metres.")?,
        table: o.default("table", SHARE, "0.57", "Table diameter as a fraction of the girdle's.")?,
        crown_degrees: o.default("crown_degrees", ACUTE, "34.5", "Angle of the crown mains to the girdle plane, degrees.")?,
        pavilion_degrees: o.default("pavilion_degrees", ACUTE, "40.75", "Angle of the pavilion mains to the girdle plane, degrees.")?,
        girdle: o.default("girdle", SHARE, "0.03", "Girdle thickness as a fraction of its diameter.")?,
        star: o.default("star", SHARE, "0.5", "Length of the star facets: share of the way from table to girdle.")?,
        lower_half: o.default("lower_half", SHARE, "0.77", "Length of the lower halves: share of the way from girdle to culet.")?,
    }))
}
