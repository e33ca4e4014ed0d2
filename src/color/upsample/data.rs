//! The tables of data/recovery, which are part of the program.

/// Numbers of a table: lines behind `#` are comments, the first other line names the columns.
///
/// Only for the program's own tables, whose tests read every one: it panics at a cell that is not a number, or at rows
/// of another length.
pub(super) fn rows<const N: usize>(text: &str) -> Vec<[f64; N]> {
    let content = text.lines().filter(|line| !line.starts_with('#')).skip(1);
    content.map(row).collect()
}

fn row<const N: usize>(line: &str) -> [f64; N] {
    let numbers: Vec<f64> = line.split(',').map(|cell| cell.parse().expect("data/recovery holds numbers")).collect();
    numbers.try_into().expect("the rows of data/recovery have as many cells as their readers expect")
}

/// The N − 1 columns of a table of wavelength (nm), joined by straight lines and held constant beyond the ends, at other
/// wavelengths that ascend.
pub(super) fn resampled<const N: usize, const M: usize>(rows: &[[f64; N]], lambdas_nm: &[f64]) -> Vec<[f64; M]> {
    let mut above = 1;
    let at = |&lambda: &f64| {
        while above + 1 < rows.len() && rows[above][0] < lambda {
            above += 1;
        }
        let (left, right) = (&rows[above - 1], &rows[above]);
        let t = ((lambda - left[0]) / (right[0] - left[0])).clamp(0.0, 1.0);
        std::array::from_fn(|k| (1.0 - t) * left[k + 1] + t * right[k + 1])
    };
    lambdas_nm.iter().map(at).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reads_and_resamples() {
        let table = rows::<3>("# a comment\nlambda,a,b\n400,1,-2\n410,2,0.5\n430,0,1e-3\n");
        assert_eq!(table[1], [410.0, 2.0, 0.5]);
        let values: Vec<[f64; 2]> = resampled(&table, &[390.0, 400.0, 405.0, 410.0, 420.0, 430.0, 440.0]);
        assert_eq!(values[..3], [[1.0, -2.0], [1.0, -2.0], [1.5, -0.75]]);
        assert_eq!((values[3][0], values[4][0], values[5], values[6]), (2.0, 1.0, [0.0, 1e-3], [0.0, 1e-3]));
    }
}
