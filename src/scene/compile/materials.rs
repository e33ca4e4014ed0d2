//! Materials and transparent media.

use super::normalize::Normalization;
use super::spectra::{Role, Spectra, in_referenced_file};
use crate::bsdf::Ggx;
use crate::io::{catalogue, refractive_index_info};
use crate::optics::ior::{Extrapolation, IndexOfRefraction};
use crate::scene::description::{ConductorDescription, IorDescription, IorKind, MaterialKind, SceneDescription};
use crate::scene::{
    ConductorMaterial, DielectricMaterial, DiffuseMaterial, Material, Medium, MediumId, MirrorMaterial, Parameter,
    SpectrumId,
};
use crate::spectrum::{PiecewiseLinear, Spectrum};
use crate::{Error, Result};

/// Materials by the index that objects use, and the media inside dielectrics.
pub struct Materials {
    /// With whether the back reflects as the front does.
    pub materials: Vec<(Material, bool)>,
    pub media: Vec<Medium>,
}

impl Materials {
    pub fn compile(
        description: &SceneDescription,
        spectra: &mut Spectra,
        normalization: &Normalization,
        warnings: &mut Vec<String>,
    ) -> Result<Self> {
        let mut media = Vec::new();
        let mut materials = Vec::new();
        for (_, material) in &description.materials {
            let two_sided = material.two_sided;
            let material = match &material.kind {
                MaterialKind::Diffuse { reflectance } => {
                    let function = spectra.resolve(reflectance, Role::Reflectance)?;
                    Material::Diffuse(DiffuseMaterial { reflectance: Parameter::Spectrum(spectra.add(&function, 1.0)) })
                }
                MaterialKind::Mirror { reflectance } => {
                    let function = spectra.resolve(reflectance, Role::Reflectance)?;
                    Material::Mirror(MirrorMaterial { reflectance: Parameter::Spectrum(spectra.add(&function, 1.0)) })
                }
                MaterialKind::Conductor { index, roughness } => {
                    let alpha = alpha(*roughness, &material.at, description, warnings);
                    conductor(index, alpha, &material.at, spectra)?
                }
                MaterialKind::Dielectric { ior, roughness, absorption_per_m, priority } => {
                    let (ior, warning) = index_of_refraction(ior)?;
                    let file = description.file.display();
                    warnings.extend(warning.map(|w| format!("{file}: {}.ior: {w}", material.at)));
                    let absorption = match absorption_per_m {
                        None => None,
                        Some(spectrum) => {
                            let function = spectra.resolve(spectrum, Role::Coefficient)?;
                            let absorbs = function.range().1 > 0.0;
                            absorbs.then(|| spectra.add(&function, normalization.meters_per_unit))
                        }
                    };
                    media.push(Medium { dispersive: ior.is_dispersive(), ior, absorption, priority: *priority });
                    let alpha = alpha(*roughness, &material.at, description, warnings);
                    Material::Dielectric(DielectricMaterial { medium: MediumId(media.len() as u32 - 1), alpha })
                }
            };
            materials.push((material, two_sided));
        }
        Ok(Self { materials, media })
    }
}

/// Roughness as it is rendered: what is too little to tell from smooth is smooth.
fn alpha(roughness: f64, at: &str, description: &SceneDescription, warnings: &mut Vec<String>) -> f32 {
    if roughness == 0.0 || roughness >= Ggx::SMOOTHEST {
        return roughness as f32;
    }
    let file = description.file.display();
    warnings.push(format!("{file}: {at}.roughness: less than {:e} is rendered as smooth", Ggx::SMOOTHEST));
    0.0
}

fn conductor(index: &ConductorDescription, alpha: f32, at: &str, spectra: &mut Spectra) -> Result<Material> {
    let (eta, k): (SpectrumId, SpectrumId) = match index {
        ConductorDescription::Metal(name) => {
            let metal = catalogue::metal(name)
                .and_then(|entry| entry.complex_index())
                .map_err(|e| Error { file: None, ..e }.at(format!("{at}.metal")))?;
            let mut add = |table: &crate::optics::table::Table| -> Result<SpectrumId> {
                let knots = PiecewiseLinear::new(table.wavelengths_nm().to_vec(), table.values().to_vec())?;
                Ok(spectra.add(&Spectrum::PiecewiseLinear(knots), 1.0))
            };
            (add(&metal.n)?, add(&metal.k)?)
        }
        ConductorDescription::EtaK { eta, k } => {
            let (eta, k) = (spectra.resolve(eta, Role::Coefficient)?, spectra.resolve(k, Role::Coefficient)?);
            (spectra.add(&eta, 1.0), spectra.add(&k, 1.0))
        }
    };
    let [eta, k] = [eta, k].map(Parameter::Spectrum);
    Ok(Material::Conductor(ConductorMaterial { eta, k, alpha }))
}

fn index_of_refraction(ior: &IorDescription) -> Result<(IndexOfRefraction, Option<String>)> {
    let at = |key: &str| format!("{}.{key}", ior.at);
    let (index, subject) = match &ior.kind {
        IorKind::Constant(n) => (IndexOfRefraction::constant(*n), "the index".to_owned()),
        IorKind::Glass(name) => {
            let entry = catalogue::glass(name).map_err(|e| Error { file: None, ..e }.at(at("glass")))?;
            (entry.constants().map(|c| c.n), format!("glass \"{}\"", entry.name))
        }
        IorKind::Sellmeier { b, c_um2 } => (IndexOfRefraction::sellmeier(b, c_um2), "the Sellmeier formula".to_owned()),
        IorKind::Cauchy(coefficients) => (IndexOfRefraction::cauchy_um(coefficients), "the Cauchy formula".to_owned()),
        IorKind::Abbe { nd, vd } => (IndexOfRefraction::from_abbe(*nd, *vd), "the index of nd and vd".to_owned()),
        IorKind::Tabulated { wavelengths_nm, values } => {
            (IndexOfRefraction::tabulated(wavelengths_nm.clone(), values.clone()), "the table".to_owned())
        }
        IorKind::File(path) => {
            let constants = refractive_index_info::read(path).map_err(|e| in_referenced_file(e, path, at("file")))?;
            (Ok(constants.n), format!("\"{}\"", path.display()))
        }
    };
    let extrapolation = if ior.hold { Extrapolation::Hold } else { Extrapolation::Continue };
    index.and_then(|index| index.checked(&subject, extrapolation)).map_err(|e| e.at(ior.at.clone()))
}
