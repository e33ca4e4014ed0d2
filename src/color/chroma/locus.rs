//! The outline of the chromaticity diagram.

use crate::color::{Observer, chromaticity};
use glam::{DVec2, DVec3};

/// Whether a chromaticity is that of some light, mixtures of spectral lights included: inside the convex hull of the locus.
///
/// The 1931 locus is concave by up to 1e-4 at its violet end and by 1e-5 along its straight red end, where mixtures lie
/// outside the locus itself. On the boundary rounding decides.
pub fn is_within_locus(xy: [f64; 2], observer: &Observer) -> bool {
    Locus::new(observer).contains(xy.into())
}

/// The observer's knots that see anything.
#[derive(Debug, Clone)]
pub(super) struct Locus {
    lambda_nm: Vec<f64>,
    xyz: Vec<DVec3>,
    /// Chromaticities.
    pub xy: Vec<DVec2>,
    /// Indices of the knots at the corners of the convex hull, anticlockwise.
    pub hull: Vec<usize>,
}

/// Point at which a half-line leaves the diagram; it has no wavelength on the line of purples.
#[derive(Clone, Copy)]
pub(super) struct Cut {
    pub lambda_nm: Option<f64>,
    pub at: DVec2,
    /// Distance from the start of the half-line in lengths of its direction.
    distance: f64,
}

impl Locus {
    pub fn new(observer: &Observer) -> Self {
        let [x, y, z] = observer.curves();
        let knots =
            y.lambdas_nm().iter().map(|&lambda| (lambda, DVec3::new(x.eval(lambda), y.eval(lambda), z.eval(lambda))));
        let (lambda_nm, xyz): (Vec<_>, Vec<_>) = knots.filter(|(_, xyz)| xyz.element_sum() > 0.0).unzip();
        let xy = xyz.iter().map(|&xyz| chromaticity(xyz).into()).collect();
        let mut locus = Self { lambda_nm, xyz, xy, hull: Vec::new() };
        locus.hull = locus.convex_hull();
        locus
    }

    /// Pairs of neighbours on the closed outline; the last pair is the line of purples.
    fn sides(&self) -> impl Iterator<Item = (usize, usize)> {
        (0..self.xy.len()).map(|i| (i, (i + 1) % self.xy.len()))
    }

    /// Whether a point is in the convex hull.
    pub fn contains(&self, point: DVec2) -> bool {
        let hull = &self.hull;
        let corner = |i: usize| self.xy[hull[i % hull.len()]];
        (0..hull.len()).all(|i| (corner(i + 1) - corner(i)).perp_dot(point - corner(i)) >= 0.0)
    }

    fn convex_hull(&self) -> Vec<usize> {
        let mut order: Vec<usize> = (0..self.xy.len()).collect();
        order.sort_by(|&i, &j| (self.xy[i].x.total_cmp(&self.xy[j].x)).then(self.xy[i].y.total_cmp(&self.xy[j].y)));
        let mut hull = self.lower_chain(order.iter().copied());
        hull.pop();
        hull.extend(self.lower_chain(order.into_iter().rev()));
        hull.pop();
        hull
    }

    /// The corners of the hull that lie to the right of the way from the first point to the last.
    fn lower_chain(&self, order: impl Iterator<Item = usize>) -> Vec<usize> {
        let mut chain: Vec<usize> = Vec::new();
        for next in order {
            while let [.., a, b] = chain[..] {
                if (self.xy[b] - self.xy[a]).perp_dot(self.xy[next] - self.xy[b]) > 0.0 {
                    break;
                }
                chain.pop();
            }
            chain.push(next);
        }
        chain
    }

    /// Finds the point at which the half-line leaves the diagram for the last time.
    pub fn outermost_cut(&self, start: DVec2, direction: DVec2) -> Option<Cut> {
        let cuts = self.sides().filter_map(|(i, j)| self.cut(i, j, start, direction));
        cuts.filter(|cut| cut.distance > 0.0).max_by(|a, b| a.distance.total_cmp(&b.distance))
    }

    /// The cut of a whole line with the side between two knots.
    fn cut(&self, i: usize, j: usize, start: DVec2, direction: DVec2) -> Option<Cut> {
        let purple = j < i;
        let [from, to] =
            [i, j].map(|k| if purple { self.xy[k].extend(1.0 - self.xy[k].element_sum()) } else { self.xyz[k] });
        // Linear in XYZ, and 0 where the chromaticity is on the line.
        let side = |xyz: DVec3| (xyz.truncate() - start * xyz.element_sum()).perp_dot(direction);
        let (a, b) = (side(from), side(to));
        if (a >= 0.0) == (b >= 0.0) {
            return None;
        }
        let t = a / (a - b);
        let at = DVec2::from(chromaticity(from.lerp(to, t)));
        let lambda_nm = (!purple).then(|| self.lambda_nm[i] + t * (self.lambda_nm[j] - self.lambda_nm[i]));
        Some(Cut { lambda_nm, at, distance: (at - start).dot(direction) / direction.length_squared() })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const D65: DVec2 = DVec2::new(0.3127, 0.3290);

    #[test]
    fn the_locus_is_the_border() {
        let observer = Observer::cie_1931_2deg();
        // Where the locus is curved it is its own hull, but for the tenths of a nanometre between samples.
        for lambda in 470..540 {
            let xy = DVec2::from(chromaticity(observer.eval(f64::from(lambda))));
            assert!(is_within_locus(D65.lerp(xy, 1.0 - 1e-9).into(), observer), "{lambda}");
            assert!(!is_within_locus(D65.lerp(xy, 1.0 + 1e-9).into(), observer), "{lambda}");
        }
        assert!(is_within_locus([0.4, 0.16], observer) && !is_within_locus([0.4, 0.1], observer));
        assert!(!is_within_locus([f64::NAN, 0.3], observer));
    }

    #[test]
    fn the_hull_leaves_out_little() {
        let locus = Locus::new(Observer::cie_1931_2deg());
        let hull = &locus.hull;
        assert!((100..470).contains(&hull.len()), "{}", hull.len());
        let area = |corners: &[DVec2]| -> f64 {
            let next = corners.iter().cycle().skip(1);
            0.5 * corners.iter().zip(next).map(|(a, b)| a.perp_dot(*b)).sum::<f64>()
        };
        let of_hull = area(&hull.iter().map(|&i| locus.xy[i]).collect::<Vec<_>>());
        // The locus runs clockwise.
        let of_locus = -area(&locus.xy);
        assert!(of_locus <= of_hull && of_hull < of_locus * 1.0005, "{of_locus} {of_hull}");
    }

    proptest! {
        #[test]
        fn mixtures_of_lights_are_lights(a in 360.0..830.0_f64, b in 360.0..830.0_f64, share in 0.0..1.0_f64) {
            let observer = Observer::cie_1931_2deg();
            let [a, b] = [a, b].map(|lambda| DVec2::from(chromaticity(observer.eval(lambda))));
            // A hair inside: on the boundary rounding decides.
            prop_assert!(is_within_locus(a.lerp(b, share).lerp(D65, 1e-12).into(), observer));
        }
    }
}
