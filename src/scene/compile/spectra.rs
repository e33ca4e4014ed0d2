//! Resolving spectra: names, files, colours and illuminants become functions, functions become tables.

use crate::color::RgbSpace;
use crate::color::illuminant;
use crate::color::upsample;
use crate::color::{Observer, normalized_to_unit_luminance};
use crate::io::spectrum_file;
use crate::scene::SpectrumId;
use crate::scene::description::{SceneDescription, SpectrumDescription, SpectrumKind};
use crate::spectrum::{PiecewiseLinear, Spectrum, SpectrumTable};
use crate::{Error, ErrorKind, Result};
use std::path::Path;

/// What a spectrum stands for; decides what an RGB colour means there and which values are legal.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Role {
    /// In [0, 1].
    Reflectance,
    /// Not negative.
    Emission,
    /// A coefficient or index; not negative, and no colour.
    Coefficient,
}

/// The spectra of a scene in the making.
pub struct Spectra<'a> {
    description: &'a SceneDescription,
    tables: Vec<SpectrumTable>,
}

impl<'a> Spectra<'a> {
    pub fn new(description: &'a SceneDescription) -> Self {
        Self { description, tables: Vec::new() }
    }

    pub fn into_tables(self) -> Vec<SpectrumTable> {
        self.tables
    }

    /// Adds `factor` times a spectrum.
    pub fn add(&mut self, spectrum: &Spectrum, factor: f64) -> SpectrumId {
        let table = match spectrum.is_constant() {
            Some(value) => SpectrumTable::constant((value * factor) as f32),
            None => {
                let knots = spectrum.tabulate().scaled(factor);
                SpectrumTable::new(knots.lambdas_nm(), knots.values())
            }
        };
        let known = self.tables.iter().position(|t| *t == table);
        SpectrumId(known.unwrap_or_else(|| {
            self.tables.push(table);
            self.tables.len() - 1
        }) as u32)
    }

    /// The function that a description stands for, in the user's units.
    pub fn resolve(&self, spectrum: &SpectrumDescription, role: Role) -> Result<Spectrum> {
        let function = self.resolve_unscaled(spectrum, role)?.scaled(spectrum.scale);
        let (min, max) = function.range();
        let legal = match role {
            Role::Reflectance => min >= 0.0 && max <= 1.0,
            Role::Emission | Role::Coefficient => min >= 0.0 && max.is_finite(),
        };
        if legal {
            return Ok(function);
        }
        let expected = match role {
            Role::Reflectance => "a reflectance lies in [0, 1]",
            Role::Emission => "emission is finite and not negative",
            Role::Coefficient => "expected finite values that are not negative",
        };
        let message = format!("the values range from {min} to {max}; {expected}");
        Err(Error::new(ErrorKind::OutOfRange, message).at(spectrum.at.clone()))
    }

    fn resolve_unscaled(&self, spectrum: &SpectrumDescription, role: Role) -> Result<Spectrum> {
        let at = |key: &str| format!("{}.{key}", spectrum.at);
        match &spectrum.kind {
            SpectrumKind::Constant(value) => Ok(Spectrum::Constant(*value)),
            SpectrumKind::Named(name) => {
                let (_, target) = self.description.spectra.iter().find(|(n, _)| n == name).ok_or_else(|| {
                    let names = self.description.spectra.iter().map(|(n, _)| n.as_str());
                    let message = format!("unknown spectrum \"{name}\"");
                    Error::new(ErrorKind::UnknownName, message).at(spectrum.at.clone()).nearest(name, names)
                })?;
                self.resolve(target, role)
            }
            SpectrumKind::Tabulated { wavelengths_nm, values } => {
                let table = PiecewiseLinear::new(wavelengths_nm.clone(), values.clone());
                Ok(Spectrum::PiecewiseLinear(table.map_err(|e| e.at(spectrum.at.clone()))?))
            }
            SpectrumKind::File(path) => {
                let table = spectrum_file::read(path).map_err(|e| in_referenced_file(e, path, at("file")))?;
                Ok(Spectrum::PiecewiseLinear(table))
            }
            SpectrumKind::Rgb { rgb, space } => {
                let space = RgbSpace::by_name(space).map_err(|e| e.at(at("space")))?;
                let upsampled = match role {
                    Role::Reflectance => upsample::reflectance(*rgb, space),
                    Role::Emission => upsample::emission(*rgb, space),
                    Role::Coefficient => Err(Error::new(
                        ErrorKind::WrongType,
                        "an RGB colour cannot stand here; expected a spectrum of absorption, eta or k",
                    )),
                };
                upsampled.map_err(|e| e.at(at("rgb")))
            }
            SpectrumKind::Illuminant(name) => illuminant::by_name(name).map_err(|e| e.at(at("illuminant"))),
            SpectrumKind::Blackbody { kelvin, normalize } => {
                let planck = Spectrum::blackbody(*kelvin).map_err(|e| e.at(at("blackbody_kelvin")))?;
                if !normalize {
                    return Ok(planck);
                }
                normalized_to_unit_luminance(planck, Observer::cie_1931_2deg())
                    .map_err(|e| e.at(at("blackbody_kelvin")))
            }
            SpectrumKind::Line { line_nm, fwhm_nm } => {
                Spectrum::line(*line_nm, *fwhm_nm).map_err(|e| e.at(at("line_nm")))
            }
        }
    }
}

/// An error in a file that the scene names: told from where the scene names it.
pub fn in_referenced_file(error: Error, path: &Path, at: String) -> Error {
    Error::new(error.kind, error.in_file(path).to_string()).at(at)
}
