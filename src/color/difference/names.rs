//! The differences of two CIE Lab colours by name.

use super::*;
use crate::{Error, Result};

/// A difference of two CIE Lab colours; where it is not symmetric the first is the reference.
pub type LabDifference = fn(DVec3, DVec3) -> f64;

const DIFFERENCES: [(&str, LabDifference); 15] = [
    ("cie1976", cie1976),
    ("cie1994", cie1994),
    ("cie1994-textiles", cie1994_textiles),
    ("cie2000", cie2000),
    ("cie2000-textiles", |lab_1, lab_2| cie2000_weighted(lab_1, lab_2, Parametric::TEXTILES)),
    ("cmc", cmc),
    ("cmc-1-1", |lab_1, lab_2| cmc_weighted(lab_1, lab_2, 1.0, 1.0)),
    ("cmc-2-1", cmc),
    ("din99", din99),
    ("din99-textiles", din99_textiles),
    ("din99b", |lab_1, lab_2| din99_distance(lab_1, lab_2, Din99::B, Din99Factors::REFERENCE)),
    ("din99c", |lab_1, lab_2| din99_distance(lab_1, lab_2, Din99::C, Din99Factors::REFERENCE)),
    ("din99d", |lab_1, lab_2| din99_distance(lab_1, lab_2, Din99::D, Din99Factors::REFERENCE)),
    ("hyab", hyab),
    ("hych", hych),
];

/// Names of the differences of Lab colours; `cmc` is `cmc-2-1`.
pub fn names() -> impl Iterator<Item = &'static str> {
    DIFFERENCES.iter().map(|(name, _)| *name)
}

/// A difference of Lab colours by its name.
///
/// # Errors
/// [`UnknownName`](crate::ErrorKind::UnknownName) with the nearest name.
pub fn by_name(name: &str) -> Result<LabDifference> {
    let found = DIFFERENCES.iter().find(|(known, _)| *known == name);
    found.map(|(_, difference)| *difference).ok_or_else(|| Error::unknown_name("colour difference", name, names()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ErrorKind;

    #[test]
    fn every_name_is_a_difference() {
        let (one, two) = (DVec3::new(50.0, 10.0, -20.0), DVec3::new(52.0, 9.0, -21.0));
        for name in names() {
            let difference = by_name(name).unwrap();
            assert_eq!(difference(one, one), 0.0, "{name}");
            assert!((0.3..5.0).contains(&difference(one, two)), "{name}: {}", difference(one, two));
        }
        let error = by_name("CIE-2000").unwrap_err();
        assert_eq!((error.kind, error.nearest.as_deref()), (ErrorKind::UnknownName, Some("cie2000")));
    }
}
