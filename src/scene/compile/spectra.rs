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
use std::cell::RefCell;
use std::path::Path;

/// What a spectrum stands for; decides what an RGB colour means there and which values are legal.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Role {
    /// A share of light, in [0, 1].
    Reflectance,
    /// Radiance or power; not negative.
    Emission,
    /// A coefficient or index; not negative, and no colour.
    Coefficient,
}

/// The spectra of a scene in the making.
pub struct Spectra<'a> {
    description: &'a SceneDescription,
    tables: Vec<SpectrumTable>,
    /// Resolving does not change the tables, but it may notice something.
    warnings: RefCell<Vec<String>>,
}

impl<'a> Spectra<'a> {
    pub fn new(description: &'a SceneDescription) -> Self {
        Self { description, tables: Vec::new(), warnings: RefCell::default() }
    }

    pub fn into_tables(self) -> Vec<SpectrumTable> {
        self.tables
    }

    /// Takes the warnings about the spectra resolved so far.
    pub fn take_warnings(&self) -> Vec<String> {
        self.warnings.take()
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
                    Role::Reflectance => self.reflectance_of_color(*rgb, space, &at("rgb")),
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

    /// The natural reflectance of a colour, or of the nearest that can be one, with a warning.
    fn reflectance_of_color(&self, rgb: [f64; 3], space: &RgbSpace, at: &str) -> Result<Spectrum> {
        let projected = upsample::projected(rgb, space)?;
        if projected.is_changed(rgb) {
            let [r, g, b] = projected.rgb;
            let warning = format!(
                "{}: {at}: nothing that reflects at most all light has the colour {rgb:?} of {} under D65; rendered as \
                 [{r:.4}, {g:.4}, {b:.4}], of the same luminance and {:.0} % of the saturation",
                self.description.file.display(),
                space.name,
                100.0 * projected.saturation
            );
            let mut warnings = self.warnings.borrow_mut();
            if !warnings.contains(&warning) {
                warnings.push(warning);
            }
        }
        Ok(projected.spectrum)
    }
}

/// Reports an error in a file that the scene names at the place where the scene names it.
pub fn in_referenced_file(error: Error, path: &Path, at: String) -> Error {
    Error::new(error.kind, error.in_file(path).to_string()).at(at)
}

#[cfg(test)]
mod tests {
    use crate::scene::{compile, description};

    fn compiled(color: &str) -> crate::Result<crate::scene::Compiled> {
        let text = format!(
            r#"{{ "camera": {{ "type": "perspective", "from": [0, 0, 4], "to": [0, 0, 0] }},
                  "film": {{ "width": 4, "height": 4 }},
                  "materials": {{ "paint": {{ "type": "diffuse", "reflectance": {color} }} }},
                  "objects": [ {{ "shape": {{ "type": "sphere", "center": [0, 0, 0], "radius": 1 }}, "material": "paint" }},
                               {{ "shape": {{ "type": "sphere", "center": [2, 0, 0], "radius": 1 }}, "material": "paint" }} ],
                  "environment": {{ "radiance": {{ "illuminant": "D65" }} }} }}"#
        );
        compile(&description::parse_str(&text, "test.json".as_ref())?.description)
    }

    #[test]
    fn colors_without_a_reflectance_are_projected_with_a_warning() {
        let scene = compiled(r#"{ "rgb": [0, 1, 0], "space": "rec2020" }"#).unwrap();
        assert_eq!(scene.warnings.len(), 1, "{:?}", scene.warnings);
        let warning = &scene.warnings[0];
        assert!(warning.starts_with("test.json: materials.paint.reflectance.rgb: nothing that reflects"), "{warning}");
        let possible = compiled(r#"{ "rgb": [0.1, 0.5, 0.2], "space": "rec2020" }"#).unwrap();
        assert!(possible.warnings.is_empty(), "{:?}", possible.warnings);
        let error = compiled(r#"{ "rgb": [0, 1.5, 0] }"#).unwrap_err();
        assert_eq!(error.place, "materials.paint.reflectance.rgb[1]", "{error}");
    }
}
