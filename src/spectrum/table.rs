//! Spectra compiled for rendering.

use super::{SampledSpectrum, Wavelengths};
use wide::f32x8;

/// A piecewise-linear function of wavelength with fast look-up; constant beyond its ends.
#[derive(Debug, Clone, PartialEq)]
pub struct SpectrumTable(Layout);

#[derive(Debug, Clone, PartialEq)]
enum Layout {
    Constant(f32),
    /// All knots on a grid of `cells_per_nm`, a power of two: value and slope, per cell, of each cell from `first_nm` on. The
    /// first and the last stand for what is beyond.
    Uniform {
        first_nm: f32,
        cells_per_nm: f32,
        pieces: Vec<[f32; 2]>,
    },
    /// Knots as uneven as a lamp with narrow lines needs: `guide[i]` is the last segment that starts at or below
    /// `first_nm` + i. The first segment starts at −∞, the last ends at ∞.
    Uneven {
        first_nm: f32,
        guide: Vec<u32>,
        segments: Vec<Segment>,
    },
}

#[derive(Debug, Clone, Copy, PartialEq)]
struct Segment {
    start_nm: f32,
    value: f32,
    slope: f32,
}

/// Most cells of a table that is stored by cells, and the most cells per nm.
const MAX_CELLS: f64 = 8192.0;
const MAX_CELLS_PER_NM: u32 = 16;

impl SpectrumTable {
    /// Makes a table of the same value at every wavelength.
    pub fn constant(value: f32) -> Self {
        Self(Layout::Constant(value))
    }

    /// Makes a table of strictly ascending knots in nm.
    pub fn new(lambda_nm: &[f64], values: &[f64]) -> Self {
        let (first, last) = (lambda_nm[0], lambda_nm[lambda_nm.len() - 1]);
        if values.iter().all(|v| *v == values[0]) {
            return Self::constant(values[0] as f32);
        }
        let grids = (0..=MAX_CELLS_PER_NM.ilog2()).map(|k| f64::from(1 << k));
        let on_grid = |cells_per_nm: f64| lambda_nm.iter().all(|l| (l * cells_per_nm).fract() == 0.0);
        if let Some(cells_per_nm) = grids.take_while(|c| (last - first) * c < MAX_CELLS).find(|c| on_grid(*c)) {
            return Self::uniform(lambda_nm, values, cells_per_nm);
        }
        let flat = |start_nm, value: f64| Segment { start_nm, value: value as f32, slope: 0.0 };
        let mut segments = vec![flat(f32::NEG_INFINITY, values[0])];
        for (l, v) in lambda_nm.windows(2).zip(values.windows(2)) {
            let (start_nm, slope) = (l[0] as f32, ((v[1] - v[0]) / (l[1] - l[0])) as f32);
            segments.push(Segment { start_nm, value: v[0] as f32, slope });
        }
        segments.push(flat(last as f32, values[values.len() - 1]));
        let first_nm = first.floor() as f32;
        let count = (last as f32 - first_nm).ceil() as usize + 1;
        let guide =
            (0..count).map(|i| segments.partition_point(|s| s.start_nm <= first_nm + i as f32) as u32 - 1).collect();
        Self(Layout::Uneven { first_nm, guide, segments })
    }

    fn uniform(lambda_nm: &[f64], values: &[f64], cells_per_nm: f64) -> Self {
        let mut pieces = vec![[values[0] as f32, 0.0]];
        for (l, v) in lambda_nm.windows(2).zip(values.windows(2)) {
            let steps = ((l[1] - l[0]) * cells_per_nm) as u32;
            let slope = (v[1] - v[0]) / f64::from(steps);
            pieces.extend((0..steps).map(|i| [(v[0] + slope * f64::from(i)) as f32, slope as f32]));
        }
        pieces.push([values[values.len() - 1] as f32, 0.0]);
        let first_nm = (lambda_nm[0] - 1.0 / cells_per_nm) as f32;
        Self(Layout::Uniform { first_nm, cells_per_nm: cells_per_nm as f32, pieces })
    }

    /// The value at a wavelength.
    pub fn eval(&self, lambda_nm: f32) -> f32 {
        let (value, slope, t) = match &self.0 {
            Layout::Constant(value) => return *value,
            Layout::Uniform { first_nm, cells_per_nm, pieces } => {
                let cell = ((lambda_nm - first_nm) * cells_per_nm).max(0.0);
                let k = (cell as usize).min(pieces.len() - 1);
                let [value, slope] = pieces[k];
                (value, slope, cell - k as f32)
            }
            Layout::Uneven { first_nm, guide, segments } => {
                let cell = lambda_nm - first_nm;
                let mut k = if cell < 0.0 { 0 } else { guide[(cell as usize).min(guide.len() - 1)] as usize };
                while segments.get(k + 1).is_some_and(|next| next.start_nm <= lambda_nm) {
                    k += 1;
                }
                let Segment { start_nm, value, slope } = segments[k];
                (value, slope, if slope == 0.0 { 0.0 } else { lambda_nm - start_nm })
            }
        };
        // Rounding must not make a spectrum negative that is 0 at a knot.
        (value + slope * t).max(0.0)
    }

    /// The values at a path's wavelengths.
    pub fn sample(&self, wavelengths: &Wavelengths) -> SampledSpectrum {
        match &self.0 {
            Layout::Constant(value) => SampledSpectrum::splat(*value),
            Layout::Uniform { first_nm, cells_per_nm, pieces } => {
                sample_uniform(*first_nm, *cells_per_nm, pieces, wavelengths)
            }
            Layout::Uneven { .. } => SampledSpectrum::new(wavelengths.lambda_nm.map(|lambda_nm| self.eval(lambda_nm))),
        }
    }
}

/// [`SpectrumTable::eval`] of a [`Layout::Uniform`] in all lanes.
fn sample_uniform(first_nm: f32, cells_per_nm: f32, pieces: &[[f32; 2]], wavelengths: &Wavelengths) -> SampledSpectrum {
    let last = pieces.len() - 1;
    let offset = f32x8::new(wavelengths.lambda_nm) - f32x8::splat(first_nm);
    let cell = (offset * f32x8::splat(cells_per_nm)).fast_max(f32x8::ZERO);
    let whole = cell.fast_min(f32x8::splat(last as f32)).trunc();
    let found = whole.fast_trunc_int().to_array().map(|k| pieces[(k as usize).min(last)]);
    let (value, slope) = (f32x8::new(found.map(|piece| piece[0])), f32x8::new(found.map(|piece| piece[1])));
    SampledSpectrum::from((value + slope * (cell - whole)).fast_max(f32x8::ZERO))
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
        assert_eq!(SpectrumTable::new(&[400.0, 500.0], &[2.0, 2.0]), SpectrumTable::constant(2.0));
    }

    /// All lanes at once give what each alone gives, to the bit.
    #[test]
    fn lanes_agree_with_single_wavelengths() {
        let uniform = SpectrumTable::new(&[400.0, 405.0, 410.0, 700.0], &[1.0, 3.0, 0.0, 2.9]);
        let halves = SpectrumTable::new(&[400.0, 400.5, 700.0], &[1.0, 3.0, 2.0]);
        assert!(matches!(halves.0, Layout::Uniform { cells_per_nm: 2.0, .. }));
        let uneven = SpectrumTable::new(&[400.0, 400.3, 700.0], &[1.0, 3.0, 2.0]);
        assert!(matches!(uneven.0, Layout::Uneven { .. }));
        for i in 0..500 {
            let lambda_nm = std::array::from_fn(|lane| 360.0 + (i * 8 + lane) as f32 * 0.117_531);
            let wavelengths = Wavelengths { lambda_nm, pdf: [1.0; 8] };
            for table in [&uniform, &halves, &uneven] {
                assert_eq!(table.sample(&wavelengths).lanes(), lambda_nm.map(|l| table.eval(l)));
            }
        }
    }

    #[test]
    fn whole_nanometres() {
        let (l, v) = ([400.0, 405.0, 410.0, 700.0], [1.0, 3.0, 0.0, 2.9]);
        let table = SpectrumTable::new(&l, &v);
        for (at, expected) in [
            (399.0, 1.0),
            (399.5, 1.0),
            (400.0, 1.0),
            (402.5, 2.0),
            (405.0, 3.0),
            (409.0, 0.6),
            (410.0, 0.0),
            (555.5, 1.455),
            (700.0, 2.9),
            (900.0, 2.9),
        ] {
            assert!((table.eval(at) - expected).abs() < 1e-5, "{at}: {}", table.eval(at));
        }
    }
}
