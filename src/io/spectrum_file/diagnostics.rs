//! Finds what is doubtful about a spectrum that is to be a colour. Some of it is refused, the rest is told.

use super::Quantity;
use crate::spectrum::PiecewiseLinear;
use crate::{Error, ErrorKind, Result};

/// The range in nm that a spectrum has to reach into: outside of it an observer sees less than 1 part in 10⁴ of white.
pub const VISIBLE_NM: [f64; 2] = [380.0, 780.0];

/// Reflectances above this look like percentages; those between 1 and this look like fluorescence or noise.
const PERCENT_FROM: f64 = 2.0;

/// Something doubtful that still leaves a meaningful result.
#[derive(Debug, Clone, PartialEq)]
pub struct Finding {
    /// Name in snake_case, which does not change between versions.
    pub name: &'static str,
    /// One line that says what was found and what was done with it.
    pub message: String,
}

/// Lists what is doubtful about a spectrum whose values are of a given kind:
///
/// * `range_ends_inside_visible`: samples start above 380 nm or end below 780 nm;
/// * `negative_values`;
/// * `looks_like_percent`, `above_one`: reflectances or transmittances above 1.
///
/// # Errors
/// One sample alone; wavelengths that miss 380–780 nm.
pub fn findings(table: &PiecewiseLinear, quantity: Quantity) -> Result<Vec<Finding>> {
    check_range(table)?;
    let mut found = Vec::new();
    found.extend(ends(table));
    found.extend(negative_values(table));
    if quantity != Quantity::Emission {
        found.extend(above_one(table));
    }
    Ok(found)
}

/// Shortest and longest wavelength, nm.
fn range_nm(table: &PiecewiseLinear) -> [f64; 2] {
    let knots = table.lambdas_nm();
    [knots[0], knots[knots.len() - 1]]
}

fn check_range(table: &PiecewiseLinear) -> Result<()> {
    let [first, last] = range_nm(table);
    let [shortest, longest] = VISIBLE_NM;
    if first == last {
        let message = format!("one sample alone, at {first} nm; expected at least two");
        return Err(Error::new(ErrorKind::Missing, message));
    }
    if last > shortest && first < longest {
        return Ok(());
    }
    let unit = match (first, last) {
        // The visible range is 3800–7800 Å and 12 800–26 300 cm⁻¹.
        (2500.0..6000.0, 6000.0..12_000.0) => "; these look like Å",
        (9000.0..20_000.0, 15_000.0..60_000.0) => "; these look like wavenumbers in cm⁻¹",
        _ => "",
    };
    let message = format!(
        "wavelengths {first}–{last} nm miss the visible; expected samples in nm within {shortest}–{longest} nm{unit}"
    );
    Err(Error::new(ErrorKind::OutOfRange, message))
}

fn ends(table: &PiecewiseLinear) -> Option<Finding> {
    let ([first, last], values) = (range_nm(table), table.values());
    let [shortest, longest] = VISIBLE_NM;
    let message = match (first > shortest, last < longest) {
        (false, false) => return None,
        (true, false) => format!("samples start at {first} nm, inside the visible; {} is held below", values[0]),
        (false, true) => {
            format!("samples end at {last} nm, inside the visible; {} is held beyond", values[values.len() - 1])
        }
        (true, true) => format!(
            "samples reach from {first} to {last} nm, not over all of the visible; {} is held below and {} beyond",
            values[0],
            values[values.len() - 1]
        ),
    };
    Some(Finding { name: "range_ends_inside_visible", message })
}

fn negative_values(table: &PiecewiseLinear) -> Option<Finding> {
    let count = table.values().iter().filter(|&&value| value < 0.0).count();
    let (lambda, lowest) = table.knots().min_by(|a, b| a.1.total_cmp(&b.1)).filter(|_| count > 0)?;
    let of = table.values().len();
    let message = format!("{count} of {of} values are negative, the lowest {lowest} at {lambda} nm; they are kept");
    Some(Finding { name: "negative_values", message })
}

fn above_one(table: &PiecewiseLinear) -> Option<Finding> {
    let (lambda, highest) = table.knots().max_by(|a, b| a.1.total_cmp(&b.1)).filter(|&(_, value)| value > 1.0)?;
    if highest > PERCENT_FROM {
        let message = format!("values up to {highest} (at {lambda} nm) look like percent");
        return Some(Finding { name: "looks_like_percent", message });
    }
    let message = format!("values up to {highest} (at {lambda} nm): more light leaves than arrives; they are kept");
    Some(Finding { name: "above_one", message })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(knots: &[(f64, f64)], quantity: Quantity) -> Result<Vec<(&'static str, String)>> {
        let table = PiecewiseLinear::new(knots.iter().map(|k| k.0).collect(), knots.iter().map(|k| k.1).collect())?;
        Ok(findings(&table, quantity)?.into_iter().map(|f| (f.name, f.message)).collect())
    }

    #[test]
    fn a_good_spectrum_has_no_findings() {
        assert_eq!(found(&[(380.0, 0.0), (780.0, 1.0)], Quantity::Reflectance).unwrap(), []);
        assert_eq!(found(&[(300.0, 50.0), (830.0, 1e4)], Quantity::Emission).unwrap(), []);
    }

    #[test]
    fn doubtful_spectra_are_told_with_figures() {
        let found = found(&[(400.0, -0.25), (500.0, 1.5), (700.0, -0.5)], Quantity::Reflectance).unwrap();
        let expected = [
            (
                "range_ends_inside_visible",
                "samples reach from 400 to 700 nm, not over all of the visible; -0.25 is held below and -0.5 beyond",
            ),
            ("negative_values", "2 of 3 values are negative, the lowest -0.5 at 700 nm; they are kept"),
            ("above_one", "values up to 1.5 (at 500 nm): more light leaves than arrives; they are kept"),
        ];
        assert_eq!(found.iter().map(|(n, m)| (*n, m.as_str())).collect::<Vec<_>>(), expected);
    }

    #[test]
    fn one_sided_ends_and_percent() {
        let names = |knots: &[(f64, f64)], quantity| found(knots, quantity).unwrap();
        let starts = &names(&[(410.5, 1.0), (800.0, 2.0)], Quantity::Emission)[0].1;
        assert_eq!(starts, "samples start at 410.5 nm, inside the visible; 1 is held below");
        let ends = &names(&[(380.0, 1.0), (779.0, 2.0)], Quantity::Emission)[0].1;
        assert_eq!(ends, "samples end at 779 nm, inside the visible; 2 is held beyond");
        let percent = names(&[(380.0, 12.0), (780.0, 93.5)], Quantity::Transmittance);
        assert_eq!(percent[0].0, "looks_like_percent");
        assert!(names(&[(380.0, 12.0), (780.0, 93.5)], Quantity::Emission).is_empty());
    }

    #[test]
    fn what_misses_the_visible_is_refused_with_a_guess_of_the_unit() {
        let message = |knots: &[(f64, f64)]| found(knots, Quantity::Emission).unwrap_err().to_string();
        assert_eq!(message(&[(550.0, 1.0)]), "one sample alone, at 550 nm; expected at least two");
        let infrared = message(&[(800.0, 1.0), (2500.0, 1.0)]);
        assert_eq!(infrared, "wavelengths 800–2500 nm miss the visible; expected samples in nm within 380–780 nm");
        assert!(message(&[(200.0, 1.0), (380.0, 1.0)]).starts_with("wavelengths 200–380 nm miss the visible"));
        assert!(message(&[(3800.0, 1.0), (7800.0, 1.0)]).ends_with("; these look like Å"));
        assert!(message(&[(12_500.0, 1.0), (25_000.0, 1.0)]).ends_with("; these look like wavenumbers in cm⁻¹"));
    }
}
