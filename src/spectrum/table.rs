//! Spectra compiled for rendering.

use super::{LANES, SampledSpectrum, Wavelengths};

/// A piecewise-linear function of wavelength with fast look-up; constant beyond its ends.
///
/// Knots may be as uneven as a lamp with narrow lines needs: an index per nanometre finds the segment.
#[derive(Debug, Clone, PartialEq)]
pub struct SpectrumTable {
    /// Start, value at the start, and slope of each segment; the first starts at −∞, the last ends at ∞.
    segments: Vec<Segment>,
    /// `guide[i]`: last segment that starts at or below `first_nm + i`.
    guide: Vec<u32>,
    first_nm: f32,
}

#[derive(Debug, Clone, Copy, PartialEq)]
struct Segment {
    start_nm: f32,
    value: f32,
    slope: f32,
}

impl SpectrumTable {
    /// The same value everywhere.
    pub fn constant(value: f32) -> Self {
        let segments = vec![Segment { start_nm: f32::NEG_INFINITY, value, slope: 0.0 }];
        Self { segments, guide: Vec::new(), first_nm: 0.0 }
    }

    /// From strictly ascending knots in nm.
    pub fn new(lambda_nm: &[f64], values: &[f64]) -> Self {
        let flat = |start_nm, value: f64| Segment { start_nm, value: value as f32, slope: 0.0 };
        let mut segments = vec![flat(f32::NEG_INFINITY, values[0])];
        for (l, v) in lambda_nm.windows(2).zip(values.windows(2)) {
            let (start_nm, slope) = (l[0] as f32, ((v[1] - v[0]) / (l[1] - l[0])) as f32);
            segments.push(Segment { start_nm, value: v[0] as f32, slope });
        }
        segments.push(flat(lambda_nm[lambda_nm.len() - 1] as f32, values[values.len() - 1]));
        let first_nm = lambda_nm[0].floor() as f32;
        let count = (lambda_nm[lambda_nm.len() - 1] as f32 - first_nm).ceil() as usize + 1;
        let guide =
            (0..count).map(|i| segments.partition_point(|s| s.start_nm <= first_nm + i as f32) as u32 - 1).collect();
        Self { segments, guide, first_nm }
    }

    /// The value, if it is the same at every wavelength.
    pub fn as_constant(&self) -> Option<f32> {
        let first = self.segments[0].value;
        self.segments.iter().all(|s| s.value == first && s.slope == 0.0).then_some(first)
    }

    /// The value at a wavelength.
    pub fn eval(&self, lambda_nm: f32) -> f32 {
        let cell = lambda_nm - self.first_nm;
        let mut k = if cell < 0.0 || self.guide.is_empty() {
            0
        } else {
            self.guide[(cell as usize).min(self.guide.len() - 1)] as usize
        };
        while k + 1 < self.segments.len() && self.segments[k + 1].start_nm <= lambda_nm {
            k += 1;
        }
        let Segment { start_nm, value, slope } = self.segments[k];
        if slope == 0.0 { value } else { (value + (lambda_nm - start_nm) * slope).max(0.0) }
    }

    /// The values at a path's wavelengths.
    pub fn sample(&self, wavelengths: &Wavelengths) -> SampledSpectrum {
        if self.guide.is_empty() {
            return SampledSpectrum::splat(self.segments[0].value);
        }
        let mut lanes = [0.0; LANES];
        for (lane, lambda) in lanes.iter_mut().zip(wavelengths.lambda_nm) {
            *lane = self.eval(lambda);
        }
        SampledSpectrum::new(lanes)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn uneven_knots() {
        let (l, v) = ([400.0, 400.5, 500.25, 500.26, 700.0], [1.0, 3.0, 2.0, 8.0, 4.0]);
        let table = SpectrumTable::new(&l, &v);
        for (l, v) in l.iter().zip(v) {
            assert!((f64::from(table.eval(*l as f32)) - v).abs() < 1e-2, "{l}");
        }
        assert_eq!(table.eval(360.0), 1.0);
        assert_eq!(table.eval(830.0), 4.0);
        assert_eq!(table.eval(450.375), 2.5);
        assert!((table.eval(500.255) - 5.0).abs() < 0.02);
        assert_eq!(SpectrumTable::constant(0.25).eval(555.0), 0.25);
        assert_eq!(table.as_constant(), None);
        assert_eq!(SpectrumTable::new(&[400.0, 500.0], &[2.0, 2.0]).as_constant(), Some(2.0));
    }
}
