//! Indices of refraction.

use std::path::PathBuf;

use super::JsonPath;
use super::codec::{
    Choice, Codec, FileName, Kind, Name, Number, Numbers, Object, Range, Record, Value, Variant, describe,
};
use super::json::Json;
use super::spectrum::table;
use super::text::quote;
use crate::{ErrorKind, Result};

/// Most coefficients of a dispersion formula.
const MAX_TERMS: usize = 16;

/// An index of refraction as written.
#[derive(Debug, Clone, PartialEq)]
pub struct IorDescription {
    /// The form.
    pub kind: IorKind,
    /// `"extrapolate": "hold"`: keep the end values outside the data's range.
    pub hold: bool,
    /// Its place in the file.
    pub at: JsonPath,
}

/// The forms an index of refraction can be written in.
#[derive(Debug, Clone, PartialEq)]
pub enum IorKind {
    /// The same index at every wavelength.
    Constant(f64),
    /// A glass of the catalogue, by name.
    Glass(String),
    /// n² = 1 + Σ bᵢ λ² / (λ² − cᵢ), λ in µm.
    Sellmeier {
        /// Strengths.
        b: Vec<f64>,
        /// Poles, µm².
        c_um2: Vec<f64>,
    },
    /// n = A + B/λ² + C/λ⁴ + …, λ in µm.
    Cauchy(Vec<f64>),
    /// Index at the d line and Abbe number.
    Abbe {
        /// n at 587.5618 nm.
        nd: f64,
        /// Abbe number (n_d − 1) / (n_F − n_C).
        vd: f64,
    },
    /// Piecewise linear.
    Tabulated {
        /// Wavelengths, nm, strictly ascending.
        wavelengths_nm: Vec<f64>,
        /// Indices there.
        values: Vec<f64>,
    },
    /// A refractiveindex.info YAML file, relative to the scene file.
    File(PathBuf),
}

#[rustfmt::skip] // one form a line
const FORMS: &[Variant<IorKind>] = &[
    Variant { name: "glass", what: "a glass", doc: "A glass of the catalogue.", read: glass },
    Variant { name: "sellmeier", what: "a Sellmeier formula", doc: "A dispersion formula.", read: sellmeier },
    Variant { name: "cauchy_um", what: "a Cauchy formula", doc: "A dispersion formula.", read: cauchy },
    Variant { name: "nd", what: "an index by its Abbe number", doc: "Cauchy's formula through n_d and V_d.", read: abbe },
    Variant { name: "wavelengths_nm", what: "a tabulated index", doc: "Piecewise linear.", read: tabulated },
    Variant { name: "file", what: "an index in a file", doc: "A record of refractiveindex.info.", read: file },
];

/// Ways to extrapolate.
const HOLD: Choice<bool> = Choice {
    what: "a way to extrapolate",
    names: &[("hold", true, "Keep the index of the nearest end of the data's range.")],
};

const RANGE: Range = Range::POSITIVE;

fn object(o: &mut Object) -> Result<IorDescription> {
    let doc = "What to do outside the data's range; without it a formula is continued by up to 100 nm, anything \
               further is an error.";
    let hold = o.optional("extrapolate", HOLD, doc)?.is_some();
    Ok(IorDescription { kind: o.form(FORMS)?, hold, at: o.at() })
}

fn glass(o: &mut Object) -> Result<IorKind> {
    let doc = "Name in the catalogue, as `abbe glass` lists them.";
    Ok(IorKind::Glass(o.required("glass", Name("a glass of the catalogue"), doc)?))
}

fn sellmeier(o: &mut Object) -> Result<IorKind> {
    let what = "a Sellmeier formula";
    let terms = Record { what, doc: "The coefficients of a Sellmeier formula.", read: sellmeier_terms };
    o.required("sellmeier", terms, "n² = 1 + Σ bᵢ λ² / (λ² − cᵢ), λ in micrometres.")
}

fn sellmeier_terms(o: &mut Object) -> Result<IorKind> {
    let b = o.required("b", Numbers::several(1, MAX_TERMS, Range::ANY), "Strengths.")?;
    let poles = Numbers::several(1, MAX_TERMS, Range::NOT_NEGATIVE);
    let c_um2 = o.required("c_um2", poles, "Poles in square micrometres, one for each strength.")?;
    o.refuse_if(b.len() != c_um2.len(), ErrorKind::WrongType, "c_um2", || {
        format!("{} poles for {} strengths; expected as many", c_um2.len(), b.len())
    })?;
    Ok(IorKind::Sellmeier { b, c_um2 })
}

fn cauchy(o: &mut Object) -> Result<IorKind> {
    let coefficients = Numbers::several(1, MAX_TERMS, Range::ANY);
    let doc = "A, B, C, … of n = A + B/λ² + C/λ⁴ + …, λ in micrometres.";
    Ok(IorKind::Cauchy(o.required("cauchy_um", coefficients, doc)?))
}

fn abbe(o: &mut Object) -> Result<IorKind> {
    Ok(IorKind::Abbe {
        nd: o.required("nd", Number(Range { min: 1.0, ..Range::POSITIVE }), "Index at the d line, 587.5618 nm.")?,
        vd: o.required("vd", Number(Range::POSITIVE), "Abbe number (n_d − 1) / (n_F − n_C).")?,
    })
}

fn tabulated(o: &mut Object) -> Result<IorKind> {
    let (wavelengths_nm, values) = table(o, RANGE, "Indices, one for each.")?;
    Ok(IorKind::Tabulated { wavelengths_nm, values })
}

fn file(o: &mut Object) -> Result<IorKind> {
    let record = FileName { what: "a refractiveindex.info record", extensions: &["yml", "yaml"] };
    Ok(IorKind::File(o.required("file", record, "Path of a refractiveindex.info record.")?))
}

/// An index of refraction relative to air.
#[derive(Debug, Clone, Copy)]
pub struct Ior;

fn kind() -> Kind {
    let table = describe("an index of refraction", "An index of refraction in one of several forms.", object).0;
    Kind::Either(vec![
        (Kind::Number(RANGE), "The same index at every wavelength."),
        (Kind::Object(Box::new(table)), ""),
    ])
}

impl Codec for Ior {
    type Value = IorDescription;

    fn kind(&self) -> Kind {
        Kind::Defined("ior", Box::new(kind))
    }

    fn read(&self, value: &Value) -> Result<IorDescription> {
        match value.json {
            Json::Integer(_) | Json::Number(_) => {
                let kind = IorKind::Constant(Number(RANGE).read(value)?);
                Ok(IorDescription { kind, hold: false, at: value.path.to_string() })
            }
            Json::Object(_) => Record { what: "an index of refraction", doc: "", read: object }.read(value),
            Json::Text(text) => {
                let expected = kind().expected();
                let message = format!("expected {expected}, found a string; a glass is {{\"glass\": {}}}", quote(text));
                Err(value.error(ErrorKind::WrongType, message))
            }
            _ => Err(value.wrong_type(&kind().expected())),
        }
    }

    fn placeholder(&self) -> IorDescription {
        IorDescription { kind: IorKind::Constant(1.0), hold: false, at: JsonPath::new() }
    }
}
