//! The round brilliant.

use glam::DVec3;

use super::{TriangleSoup, convex_solid};
use crate::{Error, ErrorKind, Result, math};

/// Proportions of a round brilliant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BrilliantCut {
    /// Distance of the girdle's corners from the axis, metres.
    pub radius: f64,
    /// Table diameter, corner to corner, as a fraction of the girdle's, in (0, 1).
    pub table: f64,
    /// Angle of the crown mains to the girdle plane, degrees in (0, 90).
    pub crown_degrees: f64,
    /// Angle of the pavilion mains to the girdle plane, degrees in (0, 90).
    pub pavilion_degrees: f64,
    /// Girdle thickness as a fraction of its diameter, in (0, 1).
    pub girdle: f64,
    /// Tip of the star facets: share of the way from the middle of a table edge to the girdle, seen from above, in (0, 1).
    pub star: f64,
    /// Tip of the lower halves: share of the way from the girdle to the culet, seen from above, in (0, 1).
    pub lower_half: f64,
}

impl Default for BrilliantCut {
    /// A cut near Tolkowsky's \[Tolkowsky1919\] as laboratories grade it today, of radius 1.
    fn default() -> Self {
        Self {
            radius: 1.0,
            table: 0.57,
            crown_degrees: 34.5,
            pavilion_degrees: 40.75,
            girdle: 0.03,
            star: 0.5,
            lower_half: 0.77,
        }
    }
}

const ORDER: u32 = 8;
/// First vertices of the rings, from the table down; the last vertex is the culet.
const TABLE: u32 = 0;
const STARS: u32 = TABLE + ORDER;
const GIRDLE_TOP: u32 = STARS + ORDER;
const GIRDLE_BOTTOM: u32 = GIRDLE_TOP + 2 * ORDER;
const LOWER: u32 = GIRDLE_BOTTOM + 2 * ORDER;
const CULET: u32 = LOWER + ORDER;

/// A round brilliant with its axis along y, the table up and the middle of the girdle in y = 0: table, 8 stars, 8 crown
/// mains, 16 upper halves, 16 flat girdle facets, 16 lower halves and 8 pavilion mains that meet in a pointed culet
/// (57 facets besides the girdle). A crown main faces +x.
///
/// Every facet is flat: the mains are planes through the girdle's corners at the given angles, neighbouring mains meet
/// in lines on which the tips of the stars and of the lower halves lie, and all other facets are triangles.
///
/// Errors: `OutOfRange` for a proportion outside its range; `Degenerate` if the stars would rise above the table.
pub fn brilliant(cut: &BrilliantCut) -> Result<TriangleSoup> {
    check_ranges(cut)?;
    Ok(convex_solid(vertices(cut)?, &facets()))
}

fn check_ranges(cut: &BrilliantCut) -> Result<()> {
    let limits = [
        ("radius", cut.radius, f64::MAX),
        ("table", cut.table, 1.0),
        ("crown_degrees", cut.crown_degrees, 90.0),
        ("pavilion_degrees", cut.pavilion_degrees, 90.0),
        ("girdle", cut.girdle, 1.0),
        ("star", cut.star, 1.0),
        ("lower_half", cut.lower_half, 1.0),
    ];
    for (name, value, limit) in limits {
        if !(value > 0.0 && value < limit) {
            let below = if limit == f64::MAX { String::new() } else { format!(" and below {limit}") };
            return Err(Error::new(ErrorKind::OutOfRange, format!("{name} is {value}; expected above 0{below}")));
        }
    }
    Ok(())
}

fn vertices(cut: &BrilliantCut) -> Result<Vec<DVec3>> {
    // In units of the girdle radius. Angles are counted in sixteenths of a turn; mains lie at even ones.
    let between = math::cos(std::f64::consts::PI / f64::from(ORDER));
    let (crown, pavilion) = (math::tan(cut.crown_degrees.to_radians()), math::tan(cut.pavilion_degrees.to_radians()));
    let crown_main = |reach: f64| cut.girdle + (1.0 - reach) * crown;
    let pavilion_main = |reach: f64| -cut.girdle - (1.0 - reach) * pavilion;
    let table_edge = cut.table * between;
    let star = table_edge + cut.star * (1.0 - table_edge);
    if star * between <= cut.table {
        let least = (cut.table / between - table_edge) / (1.0 - table_edge);
        let message = format!(
            "a star of {} is too short for a table of {}: its tip would lie above the table; expected above {least:.3}{}",
            cut.star,
            cut.table,
            if least >= 1.0 { ", so a smaller table" } else { "" }
        );
        return Err(Error::new(ErrorKind::Degenerate, message));
    }
    let lower = 1.0 - cut.lower_half;
    let ring = |radius: f64, height: f64, first: u32, step: u32| {
        (0..2 * ORDER).skip(first as usize).step_by(step as usize).map(move |i| {
            let angle = std::f64::consts::PI * f64::from(i) / f64::from(ORDER);
            DVec3::new(radius * math::cos(angle), height, radius * math::sin(angle)) * cut.radius
        })
    };
    let mut positions = Vec::with_capacity(CULET as usize + 1);
    positions.extend(ring(cut.table, crown_main(cut.table), 0, 2));
    positions.extend(ring(star, crown_main(star * between), 1, 2));
    positions.extend(ring(1.0, cut.girdle, 0, 1));
    positions.extend(ring(1.0, -cut.girdle, 0, 1));
    positions.extend(ring(lower, pavilion_main(lower * between), 1, 2));
    positions.push(DVec3::new(0.0, pavilion_main(0.0) * cut.radius, 0.0));
    Ok(positions)
}

fn facets() -> Vec<Vec<u32>> {
    let mut facets = vec![(TABLE..TABLE + ORDER).collect()];
    let girdle = |first: u32, i: u32| first + i % (2 * ORDER);
    for i in 0..ORDER {
        let (next, previous) = ((i + 1) % ORDER, (i + ORDER - 1) % ORDER);
        let main = 2 * i;
        facets.push(vec![TABLE + i, STARS + i, TABLE + next]);
        facets.push(vec![TABLE + i, STARS + previous, girdle(GIRDLE_TOP, main), STARS + i]);
        facets.push(vec![CULET, LOWER + previous, girdle(GIRDLE_BOTTOM, main), LOWER + i]);
        for side in [main, main + 1] {
            let (a, b) = (girdle(GIRDLE_TOP, side), girdle(GIRDLE_TOP, side + 1));
            let (c, d) = (girdle(GIRDLE_BOTTOM, side), girdle(GIRDLE_BOTTOM, side + 1));
            facets.push(vec![STARS + i, a, b]);
            facets.push(vec![a, b, d, c]);
            facets.push(vec![LOWER + i, c, d]);
        }
    }
    facets
}

#[cfg(test)]
mod tests {
    use super::super::tests::check;
    use super::*;

    #[test]
    fn is_a_closed_convex_solid_with_all_facets() {
        let solid = brilliant(&BrilliantCut::default()).unwrap();
        check(&solid);
        assert_eq!(solid.facet_count(), 57 + 16);
        assert_eq!(solid.positions.len(), 57);
    }

    #[test]
    fn stays_convex_over_the_range_of_cuts() {
        let mut valid = 0;
        for table in [0.1, 0.45, 0.57, 0.7, 0.9] {
            for (crown_degrees, pavilion_degrees) in [(5.0, 20.0), (34.5, 40.75), (60.0, 70.0), (85.0, 85.0)] {
                for (star, lower_half, girdle) in [(0.3, 0.5, 1e-4), (0.5, 0.77, 0.03), (0.95, 0.99, 0.5)] {
                    let cut =
                        BrilliantCut { radius: 3e-3, table, crown_degrees, pavilion_degrees, girdle, star, lower_half };
                    if let Ok(solid) = brilliant(&cut) {
                        check(&solid);
                        valid += 1;
                    }
                }
            }
        }
        assert!(valid >= 40, "{valid}");
    }

    #[test]
    fn has_standard_proportions() {
        let cut = BrilliantCut::default();
        let p = brilliant(&cut).unwrap().positions;
        let top = p[TABLE as usize].y;
        let diameter = 2.0 * cut.radius;
        let crown_height = (top - p[GIRDLE_TOP as usize].y) / diameter;
        let pavilion_depth = (p[GIRDLE_BOTTOM as usize].y - p[CULET as usize].y) / diameter;
        assert!((crown_height - 0.148).abs() < 5e-4, "{crown_height}");
        assert!((pavilion_depth - 0.431).abs() < 5e-4, "{pavilion_depth}");
        assert!((p[GIRDLE_TOP as usize].y - p[GIRDLE_BOTTOM as usize].y - 0.03 * diameter).abs() < 1e-15);
        let table = p[TABLE as usize].distance(p[TABLE as usize + 4]) / diameter;
        assert!((table - 0.57).abs() < 1e-15);
    }

    #[test]
    fn mains_stand_at_their_angles() {
        let solid = brilliant(&BrilliantCut::default()).unwrap();
        let angles: Vec<f64> = solid
            .indices
            .iter()
            .map(|t| solid.normal(*t).normalize())
            .map(|n| math::acos(n.y.abs()).to_degrees())
            .collect();
        let triangles_at = |angle: f64| angles.iter().filter(|a| (**a - angle).abs() < 1e-9).count();
        assert_eq!((triangles_at(34.5), triangles_at(40.75), triangles_at(90.0)), (16, 16, 32));
    }

    #[test]
    fn has_eightfold_and_mirror_symmetry() {
        let p = brilliant(&BrilliantCut::default()).unwrap().positions;
        let turn = glam::DQuat::from_rotation_y(std::f64::consts::FRAC_PI_4);
        for map in [&(|v: DVec3| turn * v) as &dyn Fn(DVec3) -> DVec3, &|v| v * DVec3::new(-1.0, 1.0, 1.0), &|v| {
            DVec3::new(v.z, v.y, v.x)
        }] {
            for v in &p {
                assert!(p.iter().any(|w| w.distance(map(*v)) < 1e-14));
            }
        }
    }

    #[test]
    fn impossible_cuts_are_errors() {
        let cut = BrilliantCut::default();
        let kind = |cut: BrilliantCut| brilliant(&cut).unwrap_err().kind;
        assert_eq!(kind(BrilliantCut { table: 1.0, ..cut }), ErrorKind::OutOfRange);
        assert_eq!(kind(BrilliantCut { radius: f64::NAN, ..cut }), ErrorKind::OutOfRange);
        assert_eq!(kind(BrilliantCut { crown_degrees: 90.0, ..cut }), ErrorKind::OutOfRange);
        assert_eq!(kind(BrilliantCut { girdle: 0.0, ..cut }), ErrorKind::OutOfRange);
        assert_eq!(kind(BrilliantCut { star: 0.1, ..cut }), ErrorKind::Degenerate);
    }
}
