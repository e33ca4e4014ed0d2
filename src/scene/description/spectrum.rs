//! Spectra: their forms, and the check that their values suit the role they stand in.

use std::path::PathBuf;

use super::JsonPath;
use super::codec::{
    Array, Bool, Codec, FileName, Kind, Name, Number, Numbers, Object, Range, Record, Value, Variant, describe, error,
};
use super::context::{Context, Extent};
use super::json::Json;
use super::path::Path;
use super::text::{quote, show};
use crate::io::spectrum_file;
use crate::{Error, ErrorKind, Result};

/// Most knots of one table.
const MAX_KNOTS: usize = 1_000_000;

/// Most knots of all tables of a file together.
const MAX_TOTAL_KNOTS: usize = 10_000_000;

/// Peak of a Gaussian of unit area and unit full width at half maximum: 2 √(ln 2 / π).
const GAUSSIAN_PEAK: f64 = 0.939_437_278_699_651_3;

/// A spectrum as written, with the optional factor `scale`.
#[derive(Debug, Clone, PartialEq)]
pub struct SpectrumDescription {
    /// The form.
    pub kind: SpectrumKind,
    /// Factor, 1 by default.
    pub scale: f64,
    /// Its place in the file.
    pub at: JsonPath,
}

/// The forms a spectrum can be written in.
#[derive(Debug, Clone, PartialEq)]
pub enum SpectrumKind {
    /// The same value at every wavelength.
    Constant(f64),
    /// One of `spectra`; known to exist and to be free of cycles after parsing.
    Named(String),
    /// Piecewise linear; wavelengths ascend strictly.
    Tabulated {
        /// Wavelengths, nm.
        wavelengths_nm: Vec<f64>,
        /// Values there.
        values: Vec<f64>,
    },
    /// A CSV, .spd or .spdx file, relative to the scene file.
    File(PathBuf),
    /// A colour to be upsampled.
    Rgb {
        /// Linear components.
        rgb: [f64; 3],
        /// RGB colour space by name; "srgb" by default.
        space: String,
    },
    /// A standard illuminant by name, normalised to Y = 1.
    Illuminant(String),
    /// Planck's law.
    Blackbody {
        /// Temperature, kelvin.
        kelvin: f64,
        /// Whether to scale to Y = 1; absolute radiance otherwise.
        normalize: bool,
    },
    /// A Gaussian line of unit area.
    Line {
        /// Centre, nm.
        line_nm: f64,
        /// Full width at half maximum, nm.
        fwhm_nm: f64,
    },
}

#[rustfmt::skip] // one form a paragraph
const FORMS: &[Variant<SpectrumKind>] = &[
    Variant { name: "name", what: "a spectrum by name", doc: "One of `spectra`.", read: named },
    Variant { name: "wavelengths_nm", what: "a tabulated spectrum", read: tabulated,
              doc: "Piecewise linear; constant beyond its ends, with a warning if they lie inside 400–700 nm." },
    Variant { name: "file", what: "a spectrum in a file", doc: "Piecewise linear, read from a file.", read: file },
    Variant { name: "rgb", what: "an RGB spectrum", read: rgb,
              doc: "A colour, upsampled as a reflectance (white is exactly 1) or as an emission (white develops to RGB [1, 1, 1]), \
                 according to where it stands; not for absorption, eta or k." },
    Variant { name: "illuminant", what: "an illuminant", doc: "A standard illuminant, normalised to luminance Y = 1.", read: illuminant },
    Variant { name: "blackbody_kelvin", what: "a black body", doc: "Planck's law.", read: blackbody },
    Variant { name: "line_nm", what: "a spectral line", doc: "A Gaussian of unit area.", read: line },
];

/// What a bare string stands for.
const NAME: Name = Name("one of `spectra`");

fn object(o: &mut Object) -> Result<SpectrumDescription> {
    let scale = o.default("scale", Number(Range::NOT_NEGATIVE), "1", "A factor on the whole spectrum.")?;
    Ok(SpectrumDescription { kind: o.form(FORMS)?, scale, at: o.at() })
}

fn named(o: &mut Object) -> Result<SpectrumKind> {
    Ok(SpectrumKind::Named(o.required("name", NAME, "The name of one of `spectra`.")?))
}

fn tabulated(o: &mut Object) -> Result<SpectrumKind> {
    let (wavelengths_nm, values) = table(o, Range::ANY, "Values, one for each wavelength.")?;
    o.check(|value| {
        warn_of_ends(&wavelengths_nm, value);
        Ok(())
    })?;
    Ok(SpectrumKind::Tabulated { wavelengths_nm, values })
}

fn file(o: &mut Object) -> Result<SpectrumKind> {
    let file = FileName { what: "a spectrum", extensions: &spectrum_file::EXTENSIONS };
    Ok(SpectrumKind::File(o.required("file", file, "Path of a table of wavelengths in nanometres and values.")?))
}

fn rgb(o: &mut Object) -> Result<SpectrumKind> {
    let components = Array::<3>::of(Range::NOT_NEGATIVE);
    Ok(SpectrumKind::Rgb {
        rgb: o.required("rgb", components, "Linear components, white is [1, 1, 1].")?,
        space: o.default(
            "space",
            Name("an RGB colour space"),
            "\"srgb\"",
            "The RGB colour space of the components.",
        )?,
    })
}

fn illuminant(o: &mut Object) -> Result<SpectrumKind> {
    let doc = "Name of a table of the colour library, such as D65.";
    Ok(SpectrumKind::Illuminant(o.required("illuminant", Name("an illuminant"), doc)?))
}

fn blackbody(o: &mut Object) -> Result<SpectrumKind> {
    Ok(SpectrumKind::Blackbody {
        kelvin: o.required("blackbody_kelvin", Number(Range::above_to(0.0, 1e9)), "Temperature, K.")?,
        normalize: o.default(
            "normalize",
            Bool,
            "true",
            "Whether to scale to Y = 1; otherwise absolute Planck radiance.",
        )?,
    })
}

fn line(o: &mut Object) -> Result<SpectrumKind> {
    let line_nm = o.required("line_nm", Number(Range::POSITIVE), "Centre, nanometres.")?;
    let fwhm_nm = o.required("fwhm_nm", Number(Range::POSITIVE), "Full width at half maximum, nanometres.")?;
    o.check(|value| check_unit(line_nm, &Path::Key(value.path, "line_nm")))?;
    Ok(SpectrumKind::Line { line_nm, fwhm_nm })
}

/// Wavelengths and values of a table.
pub fn table(o: &mut Object, range: Range, doc: &'static str) -> Result<(Vec<f64>, Vec<f64>)> {
    let wavelengths = Numbers::several(1, MAX_KNOTS, Range::POSITIVE);
    let wavelengths = o.required("wavelengths_nm", wavelengths, "Wavelengths in nanometres, strictly ascending.")?;
    let values = o.required("values", Numbers::several(1, MAX_KNOTS, range), doc)?;
    o.refuse_if(wavelengths.len() != values.len(), ErrorKind::WrongType, "values", || {
        format!("{} values for {} wavelengths; expected as many", values.len(), wavelengths.len())
    })?;
    o.check(|value| check_knots(&wavelengths, value))?;
    Ok((wavelengths, values))
}

/// Checks the wavelengths of a table whose object stands at `value`.
fn check_knots(wavelengths: &[f64], value: &Value) -> Result<()> {
    let path = Path::Key(value.path, "wavelengths_nm");
    let knots = &value.context.knots;
    knots.set(knots.get() + wavelengths.len());
    if knots.get() > MAX_TOTAL_KNOTS {
        let message = format!("the file's tables have more than {MAX_TOTAL_KNOTS} values, the limit");
        return Err(error(ErrorKind::LimitExceeded, &path, message));
    }
    if let Some(i) = wavelengths.windows(2).position(|pair| pair[1] <= pair[0]) {
        let (before, here) = (show(wavelengths[i]), show(wavelengths[i + 1]));
        let message = format!("wavelengths must ascend strictly; found {here} after {before}");
        return Err(error(ErrorKind::OutOfRange, &Path::Index(&path, i + 1), message));
    }
    check_unit(wavelengths[wavelengths.len() - 1], &path)
}

/// Warns of a table that ends where the eye sees well: beyond its ends it is constant, which is a guess.
fn warn_of_ends(wavelengths_nm: &[f64], value: &Value) {
    let (first, last) = (wavelengths_nm[0], wavelengths_nm[wavelengths_nm.len() - 1]);
    if first > 400.0 || last < 700.0 {
        let (path, first, last) = (value.path, show(first), show(last));
        value.context.warnings.borrow_mut().push(format!(
            "{path}: the table covers {first}–{last} nm; beyond its ends, inside 400–700 nm, it is held constant"
        ));
    }
}

/// Refuses wavelengths that are plainly not in nanometres.
fn check_unit(largest: f64, path: &Path) -> Result<()> {
    let (unit, factor) = match largest {
        x if x < 1e-3 => ("metres", 1e9),
        x if x < 20.0 => ("micrometres", 1e3),
        _ => return Ok(()),
    };
    let nanometres = (largest * factor * 1e3).round() / 1e3;
    let message =
        format!("expected nanometres, found {}, which looks like {unit} ({} nm)", show(largest), show(nanometres));
    Err(error(ErrorKind::OutOfRange, path, message))
}

/// What a spectrum stands for, which decides its range and how RGB is upsampled.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Role {
    /// Not known yet: an entry of `spectra`.
    Named,
    /// A fraction of light.
    Reflectance,
    /// Radiance, intensity, irradiance or power.
    Emission,
    /// An absorption coefficient, per metre.
    Absorption,
    /// A part of a complex index.
    Index,
}

impl Role {
    /// Its name in the schema, its name with article, its range, and whether an RGB colour can stand there.
    fn facts(self) -> (&'static str, &'static str, Range, bool) {
        match self {
            Role::Named => ("spectrum", "a spectrum", Range::ANY, true),
            Role::Reflectance => ("reflectance", "a reflectance", Range::FRACTION, true),
            Role::Emission => ("emission", "an emission", Range::NOT_NEGATIVE, true),
            Role::Absorption => ("absorption", "an absorption", Range::NOT_NEGATIVE, false),
            Role::Index => ("complex_index", "a complex index", Range::NOT_NEGATIVE, false),
        }
    }

    fn kind(self) -> Kind {
        let (_, what, range, takes_rgb) = self.facts();
        let mut table = describe(what, "A spectrum in one of several forms.", object).0;
        table.variants.retain(|(key, _)| takes_rgb || *key != "rgb");
        Kind::Either(vec![
            (Kind::Number(range), "The same value at every wavelength."),
            (NAME.kind(), "The name of one of `spectra`."),
            (Kind::Object(Box::new(table)), ""),
        ])
    }
}

/// A spectrum in a role.
#[derive(Debug, Clone, Copy)]
pub struct Spectrum(pub Role);

/// A spectrum in the role of a reflectance.
pub const REFLECTANCE: Spectrum = Spectrum(Role::Reflectance);
/// A spectrum in the role of an emission.
pub const EMISSION: Spectrum = Spectrum(Role::Emission);

impl Codec for Spectrum {
    type Value = SpectrumDescription;

    fn kind(&self) -> Kind {
        let role = self.0;
        Kind::Defined(role.facts().0, Box::new(move || role.kind()))
    }

    fn read(&self, value: &Value) -> Result<SpectrumDescription> {
        let bare = |kind| SpectrumDescription { kind, scale: 1.0, at: value.path.to_string() };
        let spectrum = match value.json {
            Json::Integer(_) | Json::Number(_) => bare(SpectrumKind::Constant(Number(Range::ANY).read(value)?)),
            Json::Text(_) => bare(SpectrumKind::Named(NAME.read(value)?)),
            Json::Object(_) => Record { what: "a spectrum", doc: "", read: object }.read(value)?,
            _ => return Err(value.wrong_type(&self.kind().expected())),
        };
        if self.0 != Role::Named {
            check_role(self.0, &spectrum, value.context)?;
        }
        Ok(spectrum)
    }

    fn placeholder(&self) -> SpectrumDescription {
        SpectrumDescription { kind: SpectrumKind::Constant(0.0), scale: 1.0, at: JsonPath::new() }
    }
}

/// Multiplies what a spectrum spans.
pub fn scaled(extent: &Extent, scale: f64) -> Extent {
    Extent { low: extent.low * scale, high: extent.high * scale, ..extent.clone() }
}

/// What a spectrum spans, if it can be told from its own description.
pub fn extent_of(spectrum: &SpectrumDescription) -> Option<Extent> {
    let at = &spectrum.at;
    let span = |values: &[f64], key: &str| {
        let place = |i: usize| format!("{at}{key}[{i}]");
        let by_value = |&(_, a): &(usize, &f64), &(_, b): &(usize, &f64)| a.total_cmp(b);
        let (low_index, low) = values.iter().enumerate().min_by(by_value)?;
        let (high_index, high) = values.iter().enumerate().max_by(by_value)?;
        let (low_at, high_at) = (place(low_index), place(high_index));
        Some(Extent { low: *low, high: *high, low_at, high_at, is_rgb: false })
    };
    let flat = |low: f64, high: f64| Extent { low, high, low_at: at.clone(), high_at: at.clone(), is_rgb: false };
    let extent = match &spectrum.kind {
        SpectrumKind::Constant(value) => flat(*value, *value),
        SpectrumKind::Tabulated { values, .. } => span(values, ".values")?,
        SpectrumKind::Rgb { rgb, .. } => Extent { is_rgb: true, ..span(rgb, ".rgb")? },
        SpectrumKind::Line { fwhm_nm, .. } => flat(0.0, GAUSSIAN_PEAK / fwhm_nm),
        SpectrumKind::Named(_)
        | SpectrumKind::File(_)
        | SpectrumKind::Illuminant(_)
        | SpectrumKind::Blackbody { .. } => return None,
    };
    Some(scaled(&extent, spectrum.scale))
}

/// Checks that the values of a spectrum suit its role, and that its name is known.
fn check_role(role: Role, spectrum: &SpectrumDescription, context: &Context) -> Result<()> {
    let extent = match &spectrum.kind {
        SpectrumKind::Named(name) => {
            let index = context.spectra.borrow_mut().find(name, "spectrum", "spectra", &spectrum.at)?;
            context.extents.borrow()[index].as_ref().map(|extent| scaled(extent, spectrum.scale))
        }
        _ => extent_of(spectrum),
    };
    let Some(extent) = extent else { return Ok(()) };
    let (_, what, range, takes_rgb) = role.facts();
    if extent.is_rgb && !takes_rgb {
        let message = format!("{what} cannot be an RGB colour; expected a spectrum in its own unit");
        return Err(Error::new(ErrorKind::WrongType, message).at(spectrum.at.clone()));
    }
    let (value, value_at) = match (range.contains(extent.low), range.contains(extent.high)) {
        (true, true) => return Ok(()),
        (false, _) => (extent.low, &extent.low_at),
        (_, false) => (extent.high, &extent.high_at),
    };
    let by_name = match &spectrum.kind {
        SpectrumKind::Named(name) => format!(" (spectrum {}, {value_at})", quote(name)),
        _ => String::new(),
    };
    let place = if by_name.is_empty() { value_at } else { &spectrum.at };
    let message = format!("expected {what}, a number{}, found {}{by_name}", range.describe(), show(value));
    Err(Error::new(ErrorKind::OutOfRange, message).at(place.clone()))
}
