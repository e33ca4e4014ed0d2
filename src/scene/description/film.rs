//! The film.

use super::codec::{Integer, KnownName, Number, Object, Range, Record, Variant};
use crate::color::Observer;
use crate::{ErrorKind, Result};

/// Largest width or height of a picture, pixels.
pub const MAX_SIDE: u32 = 1 << 20;

/// Most pixels of a picture.
pub const MAX_PIXELS: u64 = 1 << 32;

/// Picture size in pixels and the reconstruction filter.
#[derive(Debug, Clone, PartialEq)]
pub struct FilmDescription {
    /// Pixels per row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Filter shape.
    pub filter: FilterKind,
    /// Filter radius, pixels.
    pub filter_radius: f64,
    /// Name of the observer whose XYZ is recorded.
    pub observer: String,
}

/// Reconstruction filters.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FilterKind {
    /// Constant inside the radius (default, radius 0.5).
    Box,
    /// Gaussian cut at the radius (default radius 1.5; standard deviation radius / 3).
    Gaussian,
    /// Blackman–Harris window over the radius (default radius 1.5).
    BlackmanHarris,
}

#[rustfmt::skip] // one filter a paragraph
const FILTERS: &[Variant<(FilterKind, f64)>] = &[
    Variant { name: "box", what: "a box filter", doc: "Constant.",
              read: |o| Ok((FilterKind::Box, radius(o, "0.5")?)) },
    Variant { name: "gaussian", what: "a Gaussian filter", doc: "A Gaussian of standard deviation radius / 3, cut at the radius.",
              read: |o| Ok((FilterKind::Gaussian, radius(o, "1.5")?)) },
    Variant { name: "blackman-harris", what: "a Blackman–Harris filter", doc: "The Blackman–Harris window.",
              read: |o| Ok((FilterKind::BlackmanHarris, radius(o, "1.5")?)) },
];

const FILTER: Record<(FilterKind, f64)> = Record { what: "a filter", doc: "A reconstruction filter.", read: filter };

/// The film.
pub const FILM: Record<FilmDescription> =
    Record { what: "a film", doc: "Picture size and reconstruction filter.", read: film };

fn radius(o: &mut Object, default: &'static str) -> Result<f64> {
    o.default("radius", Number(Range::above_to(0.0, 64.0)), default, "Half width, pixels.")
}

fn filter(o: &mut Object) -> Result<(FilterKind, f64)> {
    let filter = o.tagged("type", FILTERS)?;
    o.name()?;
    Ok(filter)
}

fn film(o: &mut Object) -> Result<FilmDescription> {
    let side = Integer { min: 1, max: MAX_SIDE.into() };
    let width = o.required("width", side, "Pixels in a row.")? as u32;
    let height = o.required("height", side, "Rows; width × height is at most 2^32.")? as u32;
    let doc = "Reconstruction filter; a box of 0.5 pixel by default.";
    let (filter, filter_radius) = o.default("filter", FILTER, "{\"type\": \"box\"}", doc)?;
    let observer = KnownName { what: "an observer", names: || Observer::names().collect() };
    let doc = "Whose XYZ the film records, and by whose eyes wavelengths are chosen: CIE year and field in degrees.";
    let observer = o.default("observer", observer, "\"1931-2\"", doc)?;
    o.name()?;
    let too_many = u64::from(width) * u64::from(height) > MAX_PIXELS;
    o.refuse_if(too_many, ErrorKind::LimitExceeded, "", || {
        format!("{width} × {height} pixels; the limit is {MAX_PIXELS} pixels in all")
    })?;
    Ok(FilmDescription { width, height, filter, filter_radius, observer })
}
