//! Index of refraction as a function of wavelength, and what may be asked of it beyond its data.

use super::dispersion::{Dispersion, Power, Sellmeier};
use super::table::Table;
use crate::{Error, ErrorKind, Result};

/// The wavelengths that a render needs an index for, nm.
pub const RENDERING_RANGE_NM: [f64; 2] = [360.0, 830.0];

/// How far beyond its range of validity a formula is continued, nm.
pub const CONTINUATION_NM: f64 = 100.0;

/// The largest index that is believed; anything above is taken for a mistake in the data.
pub const MAX_INDEX: f64 = 100.0;

/// Helium d line, nm: the wavelength of n_d.
pub const LINE_D_NM: f64 = 587.5618;
/// Hydrogen F line, nm: blue end of the Abbe number.
pub const LINE_F_NM: f64 = 486.1327;
/// Hydrogen C line, nm: red end of the Abbe number.
pub const LINE_C_NM: f64 = 656.2725;
/// Mercury g line, nm.
pub const LINE_G_NM: f64 = 435.8343;

/// Fraunhofer's name and wavelength (nm) of the spectral lines that glass catalogues quote \[ISO7944\].
pub const FRAUNHOFER_LINES: [(&str, f64); 13] = [
    ("i", 365.0146),
    ("h", 404.6561),
    ("g", LINE_G_NM),
    ("F'", 479.9914),
    ("F", LINE_F_NM),
    ("e", 546.0740),
    ("d", LINE_D_NM),
    ("D", 589.2938),
    ("C'", 643.8469),
    ("C", LINE_C_NM),
    ("r", 706.5188),
    ("s", 852.11),
    ("t", 1013.98),
];

/// An index of refraction relative to the surrounding air: constant, by formula, or measured.
#[derive(Debug, Clone, PartialEq)]
pub enum IndexOfRefraction {
    /// An index that is the same at every wavelength.
    Constant(f64),
    /// A dispersion formula with its range of validity.
    Formula(Formula),
    /// Measured values, piecewise linear.
    Table(Table),
}

/// A dispersion formula with its range of validity.
#[derive(Debug, Clone, PartialEq)]
pub struct Formula {
    dispersion: Dispersion,
    /// Range of validity, nm; without bounds (0 to infinity) where the source states none.
    range_nm: [f64; 2],
    /// Wavelengths are clamped to this range: the range of validity when its end values are held, else everything.
    clamp_nm: [f64; 2],
}

impl Formula {
    /// Index at a wavelength in nm.
    #[inline]
    fn eval(&self, lambda_nm: f64) -> f64 {
        self.dispersion.eval_um(lambda_nm.max(self.clamp_nm[0]).min(self.clamp_nm[1]) * 1e-3)
    }

    /// The formula itself.
    pub fn dispersion(&self) -> &Dispersion {
        &self.dispersion
    }
}

/// What to do at wavelengths outside the data.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Extrapolation {
    /// Continue a formula by up to [`CONTINUATION_NM`] while 1 < n < ∞, with a warning; anything further is an error.
    Continue,
    /// Keep the values at the ends of the range.
    Hold,
}

const EVERYWHERE: [f64; 2] = [0.0, f64::INFINITY];

impl IndexOfRefraction {
    /// Makes an index that is the same at every wavelength; in (0, [`MAX_INDEX`]], below 1 for a bubble in something denser.
    ///
    /// # Errors
    /// `NotFinite`, `OutOfRange`.
    pub fn constant(n: f64) -> Result<Self> {
        check_index(n, "the index of refraction", 0.0)?;
        Ok(Self::Constant(n))
    }

    /// n² = 1 + Σ bᵢ λ² / (λ² − cᵢ), λ in µm and cᵢ in µm², valid everywhere.
    ///
    /// # Errors
    /// `Missing` if the lists are empty or of unequal length, `NotFinite`.
    pub fn sellmeier(b: &[f64], c_um2: &[f64]) -> Result<Self> {
        if b.is_empty() || b.len() != c_um2.len() {
            let message =
                format!("expected as many b as c_um2 and at least one, found {} and {}", b.len(), c_um2.len());
            return Err(Error::new(ErrorKind::Missing, message));
        }
        if let Some(x) = b.iter().chain(c_um2).find(|x| !x.is_finite()) {
            return Err(Error::new(ErrorKind::NotFinite, format!("a coefficient is {x}: expected a finite number")));
        }
        let terms = b.iter().zip(c_um2).map(|(&b, &c_um2)| Sellmeier { b, c_um2 }).collect();
        Ok(Self::valid_everywhere(Dispersion::Sellmeier { offset: 0.0, terms }))
    }

    /// n = A + B/λ² + C/λ⁴ + …, λ in µm, valid everywhere.
    ///
    /// # Errors
    /// `Missing` for an empty list, `NotFinite`.
    pub fn cauchy_um(coefficients: &[f64]) -> Result<Self> {
        if let Some(x) = coefficients.iter().find(|x| !x.is_finite()) {
            return Err(Error::new(ErrorKind::NotFinite, format!("a coefficient is {x}: expected a finite number")));
        }
        let Some((&constant, rest)) = coefficients.split_first() else {
            return Err(Error::new(ErrorKind::Missing, "expected at least one coefficient, found none"));
        };
        let power = |(i, &a): (usize, &f64)| Power { a, exponent: -2.0 * (i as f64 + 1.0) };
        let powers = rest.iter().enumerate().map(power).collect();
        Ok(Self::valid_everywhere(Dispersion::Cauchy { constant, powers }))
    }

    /// The two-parameter Cauchy formula n = A + B/λ² with the given index at the d line and the given Abbe number
    /// V_d = (n_d − 1) / (n_F − n_C).
    ///
    /// # Errors
    /// `NotFinite`; `OutOfRange` unless 0 < n_d ≤ [`MAX_INDEX`] and V_d > 0.
    pub fn from_abbe(n_d: f64, v_d: f64) -> Result<Self> {
        check_index(n_d, "n_d", 0.0)?;
        if !v_d.is_finite() {
            return Err(Error::new(
                ErrorKind::NotFinite,
                format!("the Abbe number is {v_d}: expected a finite number"),
            ));
        }
        if v_d <= 0.0 {
            return Err(Error::new(ErrorKind::OutOfRange, format!("the Abbe number is {v_d}: expected more than 0")));
        }
        let inverse_square_um = |nm: f64| 1.0 / (nm * 1e-3 * (nm * 1e-3));
        let b = (n_d - 1.0) / v_d / (inverse_square_um(LINE_F_NM) - inverse_square_um(LINE_C_NM));
        Self::cauchy_um(&[n_d - b * inverse_square_um(LINE_D_NM), b])
    }

    /// Measured indices, piecewise linear; see [`Table::new`] for the errors.
    ///
    /// # Errors
    /// Those of [`Table::new`].
    pub fn tabulated(wavelengths_nm: Vec<f64>, values: Vec<f64>) -> Result<Self> {
        Table::new(wavelengths_nm, values).map(Self::Table)
    }

    /// A dispersion formula that is valid in the given range, nm.
    ///
    /// # Errors
    /// `OutOfRange` unless 0 ≤ from < to.
    pub fn formula(dispersion: Dispersion, range_nm: [f64; 2]) -> Result<Self> {
        let [from, to] = range_nm;
        if !(0.0 <= from && from < to) {
            let message = format!("range of validity {from} to {to} nm: expected two ascending positive wavelengths");
            return Err(Error::new(ErrorKind::OutOfRange, message));
        }
        Ok(Self::Formula(Formula { dispersion, range_nm, clamp_nm: EVERYWHERE }))
    }

    fn valid_everywhere(dispersion: Dispersion) -> Self {
        Self::Formula(Formula { dispersion, range_nm: EVERYWHERE, clamp_nm: EVERYWHERE })
    }

    /// Index at a vacuum wavelength in nm. Outside the data a formula is continued (or held, after
    /// [`checked`](Self::checked) with [`Extrapolation::Hold`]) and a table keeps its end values.
    #[inline]
    pub fn eval(&self, lambda_nm: f64) -> f64 {
        match self {
            Self::Constant(n) => *n,
            Self::Formula(formula) => formula.eval(lambda_nm),
            Self::Table(table) => table.eval(lambda_nm),
        }
    }

    /// Index at the d line.
    pub fn n_d(&self) -> f64 {
        self.eval(LINE_D_NM)
    }

    /// Abbe number V_d = (n_d − 1) / (n_F − n_C); infinite without dispersion.
    pub fn abbe_number(&self) -> f64 {
        match self.eval(LINE_F_NM) - self.eval(LINE_C_NM) {
            0.0 => f64::INFINITY,
            principal_dispersion => (self.n_d() - 1.0) / principal_dispersion,
        }
    }

    /// Relative partial dispersion P_gF = (n_g − n_F) / (n_F − n_C); NaN without dispersion.
    pub fn partial_dispersion_gf(&self) -> f64 {
        let n_f = self.eval(LINE_F_NM);
        (self.eval(LINE_G_NM) - n_f) / (n_f - self.eval(LINE_C_NM))
    }

    /// Whether the index differs anywhere in the rendering range: a fact of the data, so that a table or formula with
    /// the same value everywhere is not dispersive. Differences at the level of rounding are none.
    pub fn is_dispersive(&self) -> bool {
        let first = self.eval(RENDERING_RANGE_NM[0]);
        let differs = |lambda_nm: f64| {
            let n = self.eval(lambda_nm);
            n.is_nan() || (n - first).abs() > 4.0 * f64::EPSILON * first.abs()
        };
        self.wavelengths_to_look_at(RENDERING_RANGE_NM).any(differs)
    }

    /// Range of the data, nm; `None` if the index is valid everywhere.
    pub fn range_nm(&self) -> Option<[f64; 2]> {
        match self {
            Self::Constant(_) => None,
            Self::Formula(formula) => (formula.range_nm != EVERYWHERE).then_some(formula.range_nm),
            Self::Table(table) => Some(table.range_nm()),
        }
    }

    /// What the data are, for people: "constant", the formula's name, "table".
    pub fn kind_name(&self) -> &'static str {
        match self {
            Self::Constant(_) => "constant",
            Self::Formula(formula) => formula.dispersion.name(),
            Self::Table(_) => "table",
        }
    }

    /// Makes sure that there is a physical index at every wavelength of the rendering range, and settles what happens
    /// outside the data. `subject` names the material in messages, such as `glass "N-BK7"`.
    ///
    /// A formula is continued by up to [`CONTINUATION_NM`] beyond its range of validity while 1 < n, which is told by
    /// the warning that is returned. Held data need no warning: the user asked for it.
    ///
    /// # Errors
    /// `OutOfRange` if the data don't reach far enough or the index is not in (0, [`MAX_INDEX`]]; `NotFinite` where a
    /// formula has no real value or a pole.
    pub fn checked(mut self, subject: &str, extrapolation: Extrapolation) -> Result<(Self, Option<String>)> {
        if extrapolation == Extrapolation::Hold
            && let Self::Formula(formula) = &mut self
        {
            formula.clamp_nm = formula.range_nm;
        }
        let warning = self.check_over(RENDERING_RANGE_NM, subject, extrapolation)?;
        Ok((self, warning))
    }

    /// Index at one wavelength in nm under the rules of [`checked`](Self::checked) with [`Extrapolation::Continue`],
    /// with the warning if the formula was continued.
    ///
    /// # Errors
    /// As for [`checked`](Self::checked); `OutOfRange` also unless 0 < `lambda_nm` < ∞.
    pub fn eval_checked(&self, lambda_nm: f64, subject: &str) -> Result<(f64, Option<String>)> {
        if !(lambda_nm > 0.0 && lambda_nm.is_finite()) {
            let message = format!("wavelength {lambda_nm} nm: expected a positive number");
            return Err(Error::new(ErrorKind::OutOfRange, message));
        }
        let warning = self.check_over([lambda_nm; 2], subject, Extrapolation::Continue)?;
        Ok((self.eval(lambda_nm), warning))
    }

    /// The rules of [`checked`](Self::checked) over the wavelengths from `needed[0]` to `needed[1]`.
    fn check_over(&self, needed: [f64; 2], subject: &str, extrapolation: Extrapolation) -> Result<Option<String>> {
        let range = self.range_nm().unwrap_or(EVERYWHERE);
        let held = extrapolation == Extrapolation::Hold;
        let excess_nm = if held { 0.0 } else { beyond(needed, range) };
        if excess_nm > 0.0 && (excess_nm > CONTINUATION_NM || matches!(self, Self::Table(_))) {
            return Err(self.too_short(needed, range, subject));
        }
        self.check_poles(needed, subject)?;
        for lambda_nm in self.wavelengths_to_look_at(needed) {
            let inside = held || (range[0] <= lambda_nm && lambda_nm <= range[1]);
            let what = format!("{subject}: the index at {} nm", number(lambda_nm));
            check_index(self.eval(lambda_nm), &what, if inside { 0.0 } else { 1.0 })?;
        }
        let continued = (excess_nm > 0.0).then(|| {
            let [from, to] = [needed[0].min(range[0]), needed[1].max(range[1])];
            format!("{subject}: {}, continued to {}", self.validity(range), span([from, to]))
        });
        Ok(continued)
    }

    /// A pole between two of the wavelengths that are looked at would not be seen there.
    fn check_poles(&self, needed: [f64; 2], subject: &str) -> Result<()> {
        let Self::Formula(formula) = self else { return Ok(()) };
        let clamp = |nm: f64| nm.max(formula.clamp_nm[0]).min(formula.clamp_nm[1]);
        let looked_at = clamp(needed[0])..=clamp(needed[1]);
        let poles_nm = formula.dispersion.poles_um2().into_iter().filter(|c| *c > 0.0).map(|c| c.sqrt() * 1e3);
        match poles_nm.into_iter().find(|pole_nm| looked_at.contains(pole_nm)) {
            None => Ok(()),
            Some(pole_nm) => {
                let message = format!(
                    "{subject}: the formula has a pole at {} nm: expected a finite index over {}",
                    number(pole_nm),
                    span(needed)
                );
                Err(Error::new(ErrorKind::NotFinite, message))
            }
        }
    }

    /// Every whole nanometre of the range, its ends, and the rows of a table.
    fn wavelengths_to_look_at(&self, [from, to]: [f64; 2]) -> impl Iterator<Item = f64> {
        let rows = match self {
            Self::Table(table) => table.wavelengths_nm(),
            _ => &[],
        };
        let rows = rows.iter().copied().filter(move |nm| (from..=to).contains(nm));
        let steps = (to - from) as u32;
        (0..=steps).map(move |step| from + f64::from(step)).chain([to]).chain(rows)
    }

    fn too_short(&self, needed: [f64; 2], range: [f64; 2], subject: &str) -> Error {
        let rule = match self {
            Self::Table(_) => "a table is not continued".to_owned(),
            _ => format!("a formula is continued by {CONTINUATION_NM} nm at most"),
        };
        let hold = if needed[0] < needed[1] { ", or \"extrapolate\": \"hold\" to keep the end values" } else { "" };
        let message = format!(
            "{subject}: {}, but {} is needed and {rule}; expected wider data{hold}",
            self.validity(range),
            span(needed)
        );
        Error::new(ErrorKind::OutOfRange, message)
    }

    fn validity(&self, range: [f64; 2]) -> String {
        match self {
            Self::Table(_) => format!("the table covers {}", span(range)),
            _ => format!("the formula is valid over {}", span(range)),
        }
    }
}

/// By how much, nm, the needed wavelengths stick out of the data; rounding in the conversion from µm is nothing.
fn beyond(needed: [f64; 2], range: [f64; 2]) -> f64 {
    let excess_nm = (range[0] - needed[0]).max(needed[1] - range[1]);
    if excess_nm > 4.0 * f64::EPSILON * needed[1] { excess_nm } else { 0.0 }
}

/// An index must be finite, above `above`, and at most [`MAX_INDEX`].
fn check_index(n: f64, what: &str, above: f64) -> Result<()> {
    if !n.is_finite() {
        return Err(Error::new(ErrorKind::NotFinite, format!("{what} is {n}: expected a finite number")));
    }
    if n <= above || n > MAX_INDEX {
        let message = format!("{what} is {n}: expected more than {above} and at most {MAX_INDEX}");
        return Err(Error::new(ErrorKind::OutOfRange, message));
    }
    Ok(())
}

/// A wavelength for people: at most three decimals, none that are zero.
fn number(nm: f64) -> String {
    let text = format!("{nm:.3}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

fn span([from, to]: [f64; 2]) -> String {
    if from == to { format!("{} nm", number(from)) } else { format!("{}–{} nm", number(from), number(to)) }
}

#[cfg(test)]
mod tests;
