//! Integrals of products of piecewise linear functions, exactly: no sampling interval, no error but rounding.
//!
//! Between two neighbours of the merged knots every factor is linear, so the product is a polynomial with a closed
//! form. A line of 0.01 nm and a table of 5 nm are therefore integrated with the same ease.

use crate::spectrum::PiecewiseLinear;

/// Every knot of the tables inside a range in nm, and its ends, ascending.
pub fn merged_knots(tables: &[&PiecewiseLinear], from_nm: f64, to_nm: f64) -> Vec<f64> {
    let inside = |&&knot: &&f64| from_nm < knot && knot < to_nm;
    let mut knots = vec![from_nm, to_nm];
    for table in tables {
        knots.extend(table.lambdas_nm().iter().filter(inside));
    }
    knots.sort_by(f64::total_cmp);
    knots.dedup();
    knots
}

/// ∫ a b dλ over a range in nm.
pub fn integral_of_product_2(a: &PiecewiseLinear, b: &PiecewiseLinear, from_nm: f64, to_nm: f64) -> f64 {
    let knots = merged_knots(&[a, b], from_nm, to_nm);
    let (a, b) = (a.eval_ascending(&knots), b.eval_ascending(&knots));
    let segment = |i: usize| segment_2(knots[i + 1] - knots[i], [a[i], a[i + 1]], [b[i], b[i + 1]]);
    (0..knots.len() - 1).map(segment).sum()
}

/// ∫ a b c dλ over a range in nm.
pub fn integral_of_product_3(
    a: &PiecewiseLinear,
    b: &PiecewiseLinear,
    c: &PiecewiseLinear,
    from_nm: f64,
    to_nm: f64,
) -> f64 {
    let knots = merged_knots(&[a, b, c], from_nm, to_nm);
    let [a, b, c] = [a, b, c].map(|table| table.eval_ascending(&knots));
    let segment = |i: usize| segment_3(knots[i + 1] - knots[i], [a[i], a[i + 1]], [b[i], b[i + 1]], [c[i], c[i + 1]]);
    (0..knots.len() - 1).map(segment).sum()
}

/// Integral of the product of two linear functions over a length, from their values at both ends.
pub(super) fn segment_2(length: f64, a: [f64; 2], b: [f64; 2]) -> f64 {
    length / 6.0 * (2.0 * (a[0] * b[0] + a[1] * b[1]) + a[0] * b[1] + a[1] * b[0])
}

/// Integral of the product of three linear functions over a length, from their values at both ends.
pub(super) fn segment_3(length: f64, a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> f64 {
    // ∫ (1 − t)³ = 1/4 and ∫ (1 − t)² t = 1/12 over [0, 1], for each choice of ends.
    let same = a[0] * b[0] * c[0] + a[1] * b[1] * c[1];
    let mixed_0 = a[0] * (b[0] * c[1] + b[1] * c[0] + b[1] * c[1]);
    let mixed_1 = a[1] * (b[0] * c[0] + b[0] * c[1] + b[1] * c[0]);
    length / 12.0 * (3.0 * same + mixed_0 + mixed_1)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::Observer;
    use crate::spectrum::Spectrum;
    use approx::assert_relative_eq;
    use proptest::prelude::*;

    fn table(knots: &[(f64, f64)]) -> PiecewiseLinear {
        PiecewiseLinear::new(knots.iter().map(|k| k.0).collect(), knots.iter().map(|k| k.1).collect()).unwrap()
    }

    #[test]
    fn polynomials_in_closed_form() {
        // x, 1 − x and x on [0, 1] nm, shifted by 1: ∫ x² = 1/3, ∫ x (1 − x) = 1/6, ∫ x² (1 − x) = 1/12, ∫ x³ = 1/4.
        let (x, y) = (table(&[(1.0, 0.0), (2.0, 1.0)]), table(&[(1.0, 1.0), (2.0, 0.0)]));
        assert_relative_eq!(integral_of_product_2(&x, &x, 1.0, 2.0), 1.0 / 3.0, max_relative = 1e-15);
        assert_relative_eq!(integral_of_product_2(&x, &y, 1.0, 2.0), 1.0 / 6.0, max_relative = 1e-15);
        assert_relative_eq!(integral_of_product_3(&x, &x, &y, 1.0, 2.0), 1.0 / 12.0, max_relative = 1e-15);
        assert_relative_eq!(integral_of_product_3(&x, &x, &x, 1.0, 2.0), 0.25, max_relative = 1e-15);
        // Constant beyond the ends: ∫ over [0.5, 3] adds 0 before and 1 after.
        assert_relative_eq!(integral_of_product_3(&x, &x, &x, 0.5, 3.0), 1.25, max_relative = 1e-15);
    }

    /// Midpoint sum of a product on cells of equal width.
    fn dense_sum(factors: &[&PiecewiseLinear], from: f64, to: f64, cells: usize) -> f64 {
        let step = (to - from) / cells as f64;
        let product = |i: usize| -> f64 {
            let lambda = from + (i as f64 + 0.5) * step;
            factors.iter().map(|f| f.eval(lambda)).product()
        };
        (0..cells).map(product).sum::<f64>() * step
    }

    #[test]
    fn a_line_of_a_hundredth_nanometre_against_dense_quadrature() {
        let line = Spectrum::line(589.2937, 0.01).unwrap().tabulate();
        let observer = Observer::cie_1931_2deg();
        let lamp = table(&[(580.0, 0.5), (589.3, 3.0), (600.0, 1.0)]);
        for curve in observer.curves() {
            let exact = integral_of_product_2(&line, curve, 360.0, 830.0);
            let dense = dense_sum(&[&line, curve], 589.25, 589.34, 200_000);
            assert_relative_eq!(exact, dense, max_relative = 1e-7);
            let exact = integral_of_product_3(&line, &lamp, curve, 360.0, 830.0);
            let dense = dense_sum(&[&line, &lamp, curve], 589.25, 589.34, 200_000);
            assert_relative_eq!(exact, dense, max_relative = 1e-7);
        }
    }

    proptest! {
        #[test]
        fn equals_dense_quadrature(
            a in prop::collection::vec((0.5..40.0_f64, 0.0..1.0_f64), 1..6),
            b in prop::collection::vec((0.5..40.0_f64, 0.0..1.0_f64), 1..6),
            c in prop::collection::vec((0.5..40.0_f64, 0.1..1.0_f64), 1..6),
        ) {
            let [a, b, c] = [a, b, c].map(|steps| {
                let mut at = 400.0;
                let knots: Vec<_> = steps.iter().map(|s| { at += s.0; (at, s.1) }).collect();
                table(&knots)
            });
            let exact = integral_of_product_3(&a, &b, &c, 400.0, 600.0);
            let dense = dense_sum(&[&a, &b, &c], 400.0, 600.0, 20_000);
            prop_assert!((exact - dense).abs() < 1e-3, "{} {}", exact, dense);
            let one = table(&[(500.0, 1.0)]);
            let two = integral_of_product_2(&a, &b, 400.0, 600.0);
            prop_assert!((integral_of_product_3(&a, &one, &b, 400.0, 600.0) - two).abs() <= 1e-13 * two.abs().max(1.0));
        }
    }
}
