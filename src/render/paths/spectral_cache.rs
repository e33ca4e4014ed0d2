//! Spectra at the wavelengths of the current path, each evaluated once.

use crate::bsdf::Indices;
use crate::scene::{MediumId, Parameter, Scene, SpectrumId};
use crate::spectrum::{LANES, SampledSpectrum, Wavelengths};

static AIR: Indices = Indices::AIR;

/// Spectra and indices of refraction at a path's wavelengths, evaluated when first asked for.
#[derive(Debug)]
pub struct SpectralCache {
    wavelengths: Wavelengths,
    /// The path that an entry belongs to.
    path: u64,
    spectra: Vec<(u64, SampledSpectrum)>,
    media: Vec<(u64, Indices)>,
}

impl SpectralCache {
    /// An empty cache for the spectra and media of a scene.
    pub fn new(scene: &Scene) -> Self {
        Self {
            wavelengths: Wavelengths { lambda_nm: [550.0; LANES], pdf: [1.0; LANES] },
            path: 0,
            spectra: vec![(0, SampledSpectrum::ZERO); scene.spectra.len()],
            media: vec![(0, Indices::AIR); scene.media.len()],
        }
    }

    /// Starts a path with other wavelengths, which forgets all values of the last one.
    pub fn begin(&mut self, wavelengths: Wavelengths) {
        self.wavelengths = wavelengths;
        self.path += 1;
    }

    /// Returns a spectrum at the path's wavelengths.
    #[inline]
    pub fn spectrum(&mut self, scene: &Scene, id: SpectrumId) -> SampledSpectrum {
        let (path, value) = &mut self.spectra[id.0 as usize];
        if *path != self.path {
            *path = self.path;
            *value = scene.spectrum(id).sample(&self.wavelengths);
        }
        *value
    }

    /// Returns a material's quantity at the path's wavelengths.
    #[inline]
    pub fn parameter(&mut self, scene: &Scene, parameter: Parameter) -> SampledSpectrum {
        match parameter {
            Parameter::Spectrum(id) => self.spectrum(scene, id),
        }
    }

    /// Returns the indices of a medium at the path's wavelengths; `None` is air.
    #[inline]
    pub fn indices(&mut self, scene: &Scene, medium: Option<MediumId>) -> &Indices {
        self.evaluate(scene, medium);
        self.evaluated(medium)
    }

    /// Returns the indices of two media at the path's wavelengths; `None` is air.
    #[inline]
    pub fn both_indices(&mut self, scene: &Scene, media: [Option<MediumId>; 2]) -> [&Indices; 2] {
        media.into_iter().for_each(|medium| self.evaluate(scene, medium));
        media.map(|medium| self.evaluated(medium))
    }

    #[inline]
    fn evaluate(&mut self, scene: &Scene, medium: Option<MediumId>) {
        let Some(id) = medium else { return };
        let (path, value) = &mut self.media[id.0 as usize];
        if *path == self.path {
            return;
        }
        *path = self.path;
        let medium = scene.medium(id);
        value.dispersive = medium.dispersive;
        if medium.dispersive {
            value.eta = self.wavelengths.lambda_nm.map(|lambda| medium.ior.eval(f64::from(lambda)));
        } else {
            value.eta = [medium.ior.eval(f64::from(self.wavelengths.lambda_nm[0])); LANES];
        }
    }

    #[inline]
    fn evaluated(&self, medium: Option<MediumId>) -> &Indices {
        medium.map_or(&AIR, |id| &self.media[id.0 as usize].1)
    }
}
