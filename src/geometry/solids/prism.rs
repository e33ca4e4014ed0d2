//! The isosceles prism.

use glam::DVec3;

use super::{TriangleSoup, convex_solid};
use crate::{Error, ErrorKind, Result, math};

/// An isosceles prism of `length` along y. Its cross-section is a triangle with the angle `apex_degrees` between two
/// sides of length `side`; the apex points to +x, and the triangle's centroid is on the y axis.
///
/// Errors: `OutOfRange` unless the angle is in (0, 180) and the lengths are positive.
pub fn prism(apex_degrees: f64, side: f64, length: f64) -> Result<TriangleSoup> {
    if !(apex_degrees > 0.0 && apex_degrees < 180.0) {
        let message = format!("apex_degrees is {apex_degrees}; expected an angle above 0 and below 180 degrees");
        return Err(Error::new(ErrorKind::OutOfRange, message));
    }
    for (name, value) in [("side", side), ("length", length)] {
        if !(value > 0.0 && value.is_finite()) {
            return Err(Error::new(ErrorKind::OutOfRange, format!("{name} is {value}; expected a positive number")));
        }
    }
    let half_angle = (0.5 * apex_degrees).to_radians();
    let (height, half_base) = (side * math::cos(half_angle), side * math::sin(half_angle));
    let section = [(2.0 / 3.0 * height, 0.0), (-height / 3.0, half_base), (-height / 3.0, -half_base)];
    let positions =
        [-0.5 * length, 0.5 * length].into_iter().flat_map(|y| section.map(|(x, z)| DVec3::new(x, y, z))).collect();
    let mut facets = vec![vec![0, 1, 2], vec![3, 4, 5]];
    facets.extend((0..3u32).map(|i| (i, (i + 1) % 3)).map(|(i, j)| vec![i, j, j + 3, i + 3]));
    Ok(convex_solid(positions, &facets))
}

#[cfg(test)]
mod tests {
    use super::super::tests::check;
    use super::*;

    #[test]
    fn is_a_closed_solid_of_the_right_size() {
        for apex in [1.0, 45.0, 60.0, 90.0, 179.0] {
            let solid = prism(apex, 0.3, 2.0).unwrap();
            check(&solid);
            assert_eq!((solid.positions.len(), solid.indices.len(), solid.facet_count()), (6, 8, 5));
            let area = 0.5 * 0.3 * 0.3 * math::sin(apex.to_radians());
            assert!((solid.volume() - 2.0 * area).abs() < 1e-14);
            let centroid: DVec3 = solid.positions.iter().sum::<DVec3>() / 6.0;
            assert!(centroid.length() < 1e-15, "{centroid}");
            let apex_point = solid.positions[0];
            assert!(solid.positions.iter().all(|p| p.x <= apex_point.x) && apex_point.z == 0.0);
        }
    }

    #[test]
    fn sixty_degrees_is_equilateral() {
        let p = prism(60.0, 1.0, 1.0).unwrap().positions;
        for (a, b) in [(0, 1), (1, 2), (2, 0)] {
            assert!((p[a].distance(p[b]) - 1.0).abs() < 1e-15);
        }
    }

    #[test]
    fn impossible_prisms_are_errors() {
        for (apex, side, length) in
            [(0.0, 1.0, 1.0), (180.0, 1.0, 1.0), (f64::NAN, 1.0, 1.0), (60.0, -1.0, 1.0), (60.0, 1.0, f64::INFINITY)]
        {
            assert_eq!(prism(apex, side, length).unwrap_err().kind, ErrorKind::OutOfRange);
        }
    }
}
