//! Lamps: the illuminant that was asked for, and what is said about any light.

use crate::cli::usage;
use crate::color::{Observer, illuminant, temperature, xyz_of_emission};
use crate::io::spectrum_file::{self, Quantity};
use crate::spectrum::Spectrum;
use crate::{Error, ErrorKind, Result};
use std::path::Path;

/// The CIE uses correlated colour temperatures up to this distance from the Planckian locus \[CIE15\].
const LARGEST_DUV: f64 = 0.05;

/// An illuminant.
#[derive(Debug)]
pub struct Lamp {
    /// As it was asked for.
    pub name: String,
    /// Its relative power.
    pub spectrum: Spectrum,
}

impl Lamp {
    /// A CIE illuminant, a blackbody (`2856K`), or a file with one spectrum.
    pub fn named(text: &str) -> Result<Self> {
        let at = |error: Error| error.at("--illuminant");
        let new = |spectrum| Self { name: text.to_owned(), spectrum };
        if let Some(kelvin) = text.strip_suffix(['K', 'k']).and_then(|number| number.trim().parse::<f64>().ok()) {
            return Spectrum::blackbody(kelvin).map(new).map_err(at);
        }
        match illuminant::by_name(text) {
            Ok(spectrum) => Ok(new(spectrum)),
            Err(_) if Path::new(text).extension().is_some_and(|_| !text.starts_with("FL3.")) => {
                Self::from_file(Path::new(text))
            }
            Err(error) => {
                let expected = format!("{}; a file such as lamp.csv; or a blackbody such as 2856K", error.message);
                Err(Error { nearest: error.nearest, ..usage(expected) }.at("--illuminant"))
            }
        }
    }

    fn from_file(path: &Path) -> Result<Self> {
        let table = spectrum_file::read(path)?;
        spectrum_file::findings(&table, Quantity::Emission).map_err(|error| error.in_file(path))?;
        let spectrum = Spectrum::PiecewiseLinear(table);
        let y = xyz_of_emission(&spectrum, Observer::cie_1931_2deg()).y;
        if y.is_nan() || y <= 0.0 {
            let message = format!("luminance {y:e} over 360–830 nm; expected a lamp with a positive one");
            return Err(Error::new(ErrorKind::OutOfRange, message).in_file(path));
        }
        let name = path.file_stem().unwrap_or_default().to_string_lossy();
        Ok(Self { name: crate::cli::swatch::harmless(&name), spectrum })
    }
}

/// What is said about a light, for the CIE 1931 observer by definition.
#[derive(Debug, Clone, PartialEq)]
pub struct LightFacts {
    /// Correlated colour temperature, K; `None` too far from the Planckian locus.
    pub cct_kelvin: Option<f64>,
    /// Distance from the Planckian locus in CIE 1960 u, v; `None` if there is no nearest point.
    pub duv: Option<f64>,
}

impl LightFacts {
    /// Those of a spectrum.
    pub fn of(spectrum: &Spectrum) -> Self {
        let xyz = xyz_of_emission(spectrum, Observer::cie_1931_2deg());
        let correlated = temperature::correlated(temperature::uv_from_xyz(xyz)).ok();
        let near = correlated.filter(|c| c.duv.abs() <= LARGEST_DUV);
        Self { cct_kelvin: near.map(|c| c.kelvin), duv: correlated.map(|c| c.duv) }
    }
}
