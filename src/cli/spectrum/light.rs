//! Lamps: the illuminant that was asked for, and what is said about any light.

use crate::cli::usage;
use crate::color::quality::{cri, tm30};
use crate::color::{Observer, illuminant, luminous, measured, temperature, xyz_of_emission};
use crate::io::spectrum_file::{self, Quantity};
use crate::spectrum::Spectrum;
use crate::{Error, ErrorKind, Result};
use std::path::Path;

/// The CIE uses correlated colour temperatures up to this distance from the Planckian locus \[CIE15\].
const LARGEST_DUV: f64 = 0.05;

/// The distance up to which the CIE holds its colour rendering index to be meaningful.
const LARGEST_DUV_OF_RENDERING: f64 = 5.4e-3;
/// What names of files with spectra end in.
const FILE_EXTENSIONS: [&str; 7] = ["csv", "txt", "tsv", "dat", "spd", "spdx", "xml"];

/// An illuminant.
#[derive(Debug)]
pub struct Lamp {
    /// Name, file or temperature that was asked for.
    pub name: String,
    /// Relative spectral power of the lamp.
    pub spectrum: Spectrum,
}

/// Colder bodies do not glow: their blue is too little to adapt by.
const COLDEST_KELVIN: f64 = 500.0;
/// The hottest blackbody that scenes know as well.
const HOTTEST_KELVIN: f64 = 1e9;

impl Lamp {
    /// A CIE illuminant, a measured lamp, a blackbody (`2856K`), or a file with one spectrum.
    pub fn named(text: &str) -> Result<Self> {
        let at = |error: Error| error.at("--illuminant");
        let new = |spectrum| Self { name: text.to_owned(), spectrum };
        if let Some(kelvin) = text.strip_suffix(['K', 'k']).and_then(|number| number.trim().parse::<f64>().ok()) {
            if !(COLDEST_KELVIN..=HOTTEST_KELVIN).contains(&kelvin) {
                let expected = format!("expected a positive one from {COLDEST_KELVIN} to {HOTTEST_KELVIN:e}");
                return Err(at(Error::new(ErrorKind::OutOfRange, format!("temperature {kelvin} K; {expected}"))));
            }
            return Spectrum::blackbody(kelvin).map(new).map_err(at);
        }
        if let Ok(spectrum) = illuminant::by_name(text).or_else(|_| measured::lamp(text)) {
            return Ok(new(spectrum));
        }
        let path = Path::new(text);
        let extension = path.extension().map(|e| e.to_ascii_lowercase().to_string_lossy().into_owned());
        if text.contains('/') || extension.is_some_and(|e| FILE_EXTENSIONS.contains(&e.as_str())) {
            return Self::from_file(path);
        }
        let message = format!(
            "unknown light {text:?}; expected a CIE illuminant such as D65, A or FL11, a blackbody such as 2856K, a measured \
             lamp, or a file such as lamp.csv"
        );
        Err(at(usage(message)).nearest(text, illuminant::names().chain(measured::lamps())))
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
    /// How colours look under it; `None` without a correlated colour temperature, or above 25 000 K.
    pub rendering: Option<Rendering>,
    /// 683 lm/W · ∫ V S dλ: cd/m² if the values are W·m⁻²·sr⁻¹·nm⁻¹.
    pub luminance: f64,
    /// Luminous efficacy of the radiation, lm/W; `None` without power.
    pub efficacy_lm_per_w: Option<f64>,
}

/// Colour rendering.
#[derive(Debug, Clone, PartialEq)]
pub struct Rendering {
    /// CIE 13.3 general colour rendering index.
    pub ra: f64,
    /// R1 to R14.
    pub r: [f64; 14],
    /// TM-30 fidelity, which is that of CIE 224.
    pub rf: f64,
    /// TM-30 gamut.
    pub rg: f64,
}

impl LightFacts {
    /// Computes the facts of a spectrum.
    pub fn of(spectrum: &Spectrum) -> Self {
        let xyz = xyz_of_emission(spectrum, Observer::cie_1931_2deg());
        let correlated = temperature::correlated(temperature::uv_from_xyz(xyz)).ok();
        let near = correlated.filter(|c| c.duv.abs() <= LARGEST_DUV);
        Self {
            cct_kelvin: near.map(|c| c.kelvin),
            duv: correlated.map(|c| c.duv),
            rendering: near.and_then(|_| Rendering::of(spectrum)),
            luminance: luminous::luminous_flux(spectrum),
            efficacy_lm_per_w: luminous::efficacy(spectrum).ok(),
        }
    }

    /// Whether the light is white enough for its colour rendering to mean something \[CIE13.3\].
    pub fn is_white(&self) -> bool {
        self.duv.is_some_and(|duv| duv.abs() <= LARGEST_DUV_OF_RENDERING)
    }
}

impl Rendering {
    fn of(spectrum: &Spectrum) -> Option<Self> {
        let (cri, tm30) = (cri(spectrum).ok()?, tm30(spectrum).ok()?);
        Some(Self { ra: cri.ra, r: cri.r, rf: tm30.rf, rg: tm30.rg })
    }
}
