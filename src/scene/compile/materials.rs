//! Materials and transparent media.

use super::compiler::Compiler;
use super::spectra::{Role, Spectra, in_referenced_file};
use crate::bsdf::Ggx;
use crate::io::{catalogue, refractive_index_info};
use crate::optics::ior::{Extrapolation, IndexOfRefraction};
use crate::scene::description::{ConductorDescription, IorDescription, IorKind, MaterialKind, SpectrumDescription};
use crate::scene::{
    ConductorMaterial, DielectricMaterial, DiffuseMaterial, Material, Medium, MediumId, MirrorMaterial, Parameter,
    SpectrumId,
};
use crate::spectrum::{PiecewiseLinear, Spectrum};
use crate::{Error, Result};

/// Materials by the index that objects use, and the media inside dielectrics.
pub struct Materials {
    /// Each material, and whether its back reflects as its front does.
    pub materials: Vec<(Material, bool)>,
    pub media: Vec<Medium>,
}

impl Materials {
    pub fn compile(compiler: &mut Compiler) -> Result<Self> {
        let mut media = Vec::new();
        let mut materials = Vec::new();
        for (_, material) in &compiler.description.materials {
            let two_sided = material.two_sided;
            let material = match &material.kind {
                MaterialKind::Diffuse { reflectance } => {
                    Material::Diffuse(DiffuseMaterial { reflectance: reflectance_of(reflectance, compiler)? })
                }
                MaterialKind::Mirror { reflectance } => {
                    Material::Mirror(MirrorMaterial { reflectance: reflectance_of(reflectance, compiler)? })
                }
                MaterialKind::Conductor { index, roughness } => {
                    let alpha = alpha(*roughness, &material.at, compiler);
                    conductor(index, alpha, &material.at, &mut compiler.spectra)?
                }
                MaterialKind::Dielectric { ior, roughness, absorption_per_m, priority } => {
                    let (ior, warning) = index_of_refraction(ior)?;
                    if let Some(warning) = warning {
                        compiler.warn(&format!("{}.ior", material.at), &warning);
                    }
                    let absorption = absorption(absorption_per_m.as_ref(), compiler)?;
                    media.push(Medium { dispersive: ior.is_dispersive(), ior, absorption, priority: *priority });
                    let alpha = alpha(*roughness, &material.at, compiler);
                    Material::Dielectric(DielectricMaterial { medium: MediumId(media.len() as u32 - 1), alpha })
                }
            };
            materials.push((material, two_sided));
        }
        Ok(Self { materials, media })
    }
}

fn reflectance_of(spectrum: &SpectrumDescription, compiler: &mut Compiler) -> Result<Parameter> {
    let function = compiler.spectra.resolve(spectrum, Role::Reflectance)?;
    Ok(Parameter::Spectrum(compiler.spectra.add(&function, 1.0)))
}

/// The absorption coefficient by the compiled scene's length; `None` if nothing is absorbed.
fn absorption(spectrum: Option<&SpectrumDescription>, compiler: &mut Compiler) -> Result<Option<SpectrumId>> {
    let Some(spectrum) = spectrum else { return Ok(None) };
    let function = compiler.spectra.resolve(spectrum, Role::Coefficient)?;
    let absorbs = function.range().1 > 0.0;
    Ok(absorbs.then(|| compiler.spectra.add(&function, compiler.normalization.meters_per_unit)))
}

/// Roughness as it is rendered: what is too little to tell from smooth is smooth.
fn alpha(roughness: f64, at: &str, compiler: &mut Compiler) -> f32 {
    if roughness == 0.0 || roughness >= Ggx::SMOOTHEST {
        return roughness as f32;
    }
    let text = format!("less than {:e} is rendered as smooth", Ggx::SMOOTHEST);
    compiler.warn(&format!("{at}.roughness"), &text);
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
