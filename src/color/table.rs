//! The tables of data/: comments behind `#`, a line of column names, one row a wavelength, empty cells for no sample.

use crate::spectrum::PiecewiseLinear;
use crate::{Error, ErrorKind, Result};

/// The lines that are not comments, with their numbers counted from 1.
fn content_lines(text: &str) -> impl Iterator<Item = (usize, &str)> {
    text.lines().enumerate().map(|(i, line)| (i + 1, line.trim())).filter(|(_, l)| !l.is_empty() && !l.starts_with('#'))
}

/// Column names, without that of the wavelength.
pub(super) fn column_names(text: &str) -> impl Iterator<Item = &str> {
    content_lines(text).next().into_iter().flat_map(|(_, header)| header.split(',').skip(1))
}

/// The samples of one column.
pub(super) fn column(text: &str, name: &str) -> Result<PiecewiseLinear> {
    let Some(index) = column_names(text).position(|n| n == name) else {
        return Err(Error::new(ErrorKind::UnknownName, format!("no column {name:?}")).nearest(name, column_names(text)));
    };
    let (mut lambda_nm, mut values) = (Vec::new(), Vec::new());
    for (line, row) in content_lines(text).skip(1) {
        let mut cells = row.split(',');
        let lambda = cells.next().unwrap_or_default();
        match cells.nth(index) {
            Some("") => {}
            Some(cell) => {
                lambda_nm.push(number(lambda, line)?);
                values.push(number(cell, line)?);
            }
            None => {
                let error =
                    Error::new(ErrorKind::FileFormat, format!("no cell for {name:?}; expected one in each row"));
                return Err(error.at(format!("line {line}")));
            }
        }
    }
    PiecewiseLinear::new(lambda_nm, values)
}

fn number(cell: &str, line: usize) -> Result<f64> {
    cell.parse().map_err(|_| {
        Error::new(ErrorKind::FileFormat, format!("{cell:?}; expected a number")).at(format!("line {line}"))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "# a comment\nwavelength_nm,A,B\n400,1,\n405,2,20\n410,3.5,-1e-3\n";

    #[test]
    fn reads_names_and_columns_with_gaps() {
        assert_eq!(column_names(TEXT).collect::<Vec<_>>(), ["A", "B"]);
        assert_eq!(column(TEXT, "A").unwrap().values(), [1.0, 2.0, 3.5]);
        let b = column(TEXT, "B").unwrap();
        assert_eq!((b.lambdas_nm(), b.values()), ([405.0, 410.0].as_slice(), [20.0, -1e-3].as_slice()));
    }

    #[test]
    fn errors_name_the_line() {
        assert_eq!(column(TEXT, "C").unwrap_err().kind, ErrorKind::UnknownName);
        let error = column("l,A\n400,1\n405\n", "A").unwrap_err();
        assert_eq!(error.to_string(), "line 3: no cell for \"A\"; expected one in each row");
        let error = column("l,A\n400,one\n", "A").unwrap_err();
        assert_eq!(error.to_string(), "line 2: \"one\"; expected a number");
        assert!(column("", "A").is_err());
    }
}
