//! Photons of a pass of merging, found again by place.

use crate::sampling::mix;
use crate::spectrum::LANES;
use glam::{IVec3, Vec3};

/// Least cosine between the normals of a photon's surface and of the surface that it is merged on.
const LEAST_COSINE: f32 = 0.9;
/// Largest distance of a photon from the plane of that surface, in radii.
const SLAB: f32 = 0.2;

/// Light that has arrived at a diffuse surface.
#[derive(Debug, Clone, Copy)]
pub struct Photon {
    /// The point at which it arrived.
    pub position: Vec3,
    /// Geometric normal, on the side where it has come from.
    pub normal: Vec3,
    /// Unit direction that it has come from.
    pub wi: Vec3,
    /// Power in each lane, times the number of paths.
    pub power: [f32; LANES],
    /// The only lane with power, if lanes have parted.
    pub lane: Option<u8>,
    /// Scattering events on its way.
    pub depth: u32,
}

impl Photon {
    /// Tells whether it belongs to the same piece of surface as a point near by.
    pub fn lies_on(&self, point: Vec3, normal: Vec3, radius: f32) -> bool {
        self.normal.dot(normal) > LEAST_COSINE && (self.position - point).dot(normal).abs() < SLAB * radius
    }
}

/// Photons sorted into the cells of a grid, cells into buckets.
#[derive(Debug, Default)]
pub struct PhotonMap {
    photons: Vec<Photon>,
    /// Where each bucket starts, and the end of the last.
    starts: Vec<u32>,
    radius: f32,
    paths: u64,
}

impl PhotonMap {
    /// Sorts photons that come in a fixed order and are to be looked up within a radius; `paths` is how many paths they came from.
    pub fn new(photons: Vec<Photon>, radius: f32, paths: u64) -> Self {
        let buckets = photons.len().next_power_of_two();
        let mut map = Self { photons: Vec::new(), starts: vec![0; buckets + 1], radius, paths };
        let of_photon: Vec<usize> = photons.iter().map(|p| map.bucket(map.cell(p.position))).collect();
        for &bucket in &of_photon {
            map.starts[bucket + 1] += 1;
        }
        for bucket in 0..buckets {
            map.starts[bucket + 1] += map.starts[bucket];
        }
        let mut next = map.starts.clone();
        let mut order = vec![0; photons.len()];
        for (photon, bucket) in of_photon.into_iter().enumerate() {
            order[next[bucket] as usize] = photon;
            next[bucket] += 1;
        }
        map.photons = order.into_iter().map(|photon| photons[photon]).collect();
        map
    }

    /// Returns the radius within which photons are looked up.
    pub fn radius(&self) -> f32 {
        self.radius
    }

    /// Returns how many paths the photons came from.
    pub fn paths(&self) -> u64 {
        self.paths
    }

    /// Calls `visit` for every photon within the radius, with its squared distance, in a fixed order.
    pub fn near(&self, point: Vec3, mut visit: impl FnMut(&Photon, f32)) {
        if self.photons.is_empty() {
            return;
        }
        // Cells are two radii wide: a ball meets the eight that are nearest.
        let corner = (point / (2.0 * self.radius) - 0.5).floor().as_ivec3();
        for neighbor in 0..8 {
            let cell = corner + IVec3::new(neighbor & 1, neighbor >> 1 & 1, neighbor >> 2);
            let bucket = self.bucket(cell);
            for photon in &self.photons[self.starts[bucket] as usize..self.starts[bucket + 1] as usize] {
                let distance2 = photon.position.distance_squared(point);
                // Buckets hold other cells as well, maybe also one of these eight.
                if distance2 < self.radius * self.radius && self.cell(photon.position) == cell {
                    visit(photon, distance2);
                }
            }
        }
    }

    fn cell(&self, position: Vec3) -> IVec3 {
        (position / (2.0 * self.radius)).floor().as_ivec3()
    }

    fn bucket(&self, cell: IVec3) -> usize {
        let [x, y, z] = cell.to_array().map(|c| u64::from(c as u32));
        let buckets = self.starts.len() - 1;
        mix(x << 42 ^ y << 21 ^ z) as usize & (buckets - 1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampling::Sobol;

    /// Every photon within the radius is found once, and no other.
    #[test]
    fn finds_the_neighbors() {
        let sobol = Sobol::new(9);
        let photon = |i: u64| {
            let u = sobol.group(i, 0);
            Photon {
                position: Vec3::new(u[0], u[1], u[2]) - 0.5,
                normal: Vec3::Z,
                wi: Vec3::Z,
                power: [1.0; LANES],
                lane: None,
                depth: i as u32,
            }
        };
        let photons: Vec<Photon> = (0..3000).map(photon).collect();
        let map = PhotonMap::new(photons.clone(), 0.07, 3000);
        let mut found_in_all = 0;
        for i in 3000..3200 {
            let point = photon(i).position;
            let mut found = Vec::new();
            map.near(point, |p, d2| {
                assert_eq!(d2, p.position.distance_squared(point));
                found.push(p.depth);
            });
            found.sort_unstable();
            let expected: Vec<u32> =
                photons.iter().filter(|p| p.position.distance_squared(point) < 0.07 * 0.07).map(|p| p.depth).collect();
            assert_eq!(found, expected);
            found_in_all += found.len();
        }
        assert!(found_in_all > 400, "{found_in_all}");
    }

    #[test]
    fn an_empty_map_finds_nothing() {
        PhotonMap::new(Vec::new(), 0.1, 10).near(Vec3::ZERO, |_, _| panic!("a photon"));
        PhotonMap::default().near(Vec3::ZERO, |_, _| panic!("a photon"));
    }
}
