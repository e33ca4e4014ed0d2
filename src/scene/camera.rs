//! The perspective camera: a pinhole, or a thin lens.

use crate::geometry::{Aabb, Ray};
use crate::sampling::concentric_disk;
use glam::Vec3;

/// A camera in the compiled scene's coordinates. The film is thought of as a rectangle at distance 1 along the axis.
#[derive(Debug, Clone)]
pub struct Camera {
    pub(super) position: Vec3,
    /// Unit axes of the picture: to the right, up, and into the scene.
    pub(super) right: Vec3,
    pub(super) up: Vec3,
    pub(super) forward: Vec3,
    /// Half the film's extent at distance 1.
    pub(super) half_extent: [f32; 2],
    /// Film size in pixels.
    pub(super) size: [u32; 2],
    pub(super) lens_radius: f32,
    pub(super) focus_distance: f32,
}

/// How a point is seen by the camera.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Connection {
    /// Position on the film, in pixels from the top left corner.
    pub film: [f32; 2],
    /// The point on the lens.
    pub lens: Vec3,
    /// 1 / (d² cos³θ a), with a the pixel's area at distance 1 and θ the angle to the axis. Multiplied by radiance, the cosine
    /// at the point, and area there, it gives the mean radiance of a pixel.
    pub importance: f32,
}

impl Camera {
    /// The ray through a point of the film (pixels from the top left corner) and a point of the lens in [0, 1)².
    pub fn ray(&self, film: [f32; 2], lens: [f32; 2]) -> Ray {
        let x = (2.0 * film[0] / self.size[0] as f32 - 1.0) * self.half_extent[0];
        let y = (1.0 - 2.0 * film[1] / self.size[1] as f32) * self.half_extent[1];
        let [u, v] = self.lens_point(lens);
        // The point in focus, seen from the point on the lens.
        let f = self.focus_distance;
        let local = if self.lens_radius > 0.0 { Vec3::new(x * f - u, y * f - v, f) } else { Vec3::new(x, y, 1.0) };
        let direction = self.right * local.x + self.up * local.y + self.forward * local.z;
        Ray { origin: self.lens_position([u, v]), direction: direction.normalize() }
    }

    /// Where a point appears through a point of the lens in [0, 1)²; `None` behind the camera or off the film by more
    /// than `margin` pixels.
    pub(crate) fn connect(&self, point: Vec3, lens: [f32; 2], margin: f32) -> Option<Connection> {
        let [u, v] = self.lens_point(lens);
        let position = self.lens_position([u, v]);
        let to_point = point - position;
        let z = to_point.dot(self.forward);
        if z <= 0.0 {
            return None;
        }
        let (mut x, mut y) = (to_point.dot(self.right) / z, to_point.dot(self.up) / z);
        if self.lens_radius > 0.0 {
            x += u / self.focus_distance;
            y += v / self.focus_distance;
        }
        let film = [
            0.5 * (x / self.half_extent[0] + 1.0) * self.size[0] as f32,
            0.5 * (1.0 - y / self.half_extent[1]) * self.size[1] as f32,
        ];
        let inside = |p: f32, size: u32| -margin <= p && p <= size as f32 + margin;
        if !(inside(film[0], self.size[0]) && inside(film[1], self.size[1])) {
            return None;
        }
        // d² cos³θ = z³ / d
        let importance = to_point.length() / (z * z * z * self.pixel_area());
        Some(Connection { film, lens: position, importance })
    }

    /// Width of a square pixel of the same area on the film at distance 1.
    pub fn pixel_width(&self) -> f32 {
        self.pixel_area().sqrt()
    }

    /// Area of a pixel on the film at distance 1.
    fn pixel_area(&self) -> f32 {
        let [w, h] = self.half_extent;
        (2.0 * w / self.size[0] as f32) * (2.0 * h / self.size[1] as f32)
    }

    /// Size of the film in pixels.
    pub fn size(&self) -> [u32; 2] {
        self.size
    }

    /// Number of pixels of the film.
    pub fn pixels(&self) -> u64 {
        u64::from(self.size[0]) * u64::from(self.size[1])
    }

    /// Position of the pinhole, or of the centre of the lens.
    pub fn position(&self) -> Vec3 {
        self.position
    }

    /// Whether all rays start at one point.
    pub fn is_pinhole(&self) -> bool {
        self.lens_radius == 0.0
    }

    /// A box around all points that rays start from.
    pub fn bounds(&self) -> Aabb {
        Aabb { min: self.position - self.lens_radius, max: self.position + self.lens_radius }
    }

    fn lens_point(&self, u: [f32; 2]) -> [f32; 2] {
        if self.lens_radius > 0.0 { concentric_disk(u).map(|p| p * self.lens_radius) } else { [0.0; 2] }
    }

    fn lens_position(&self, [u, v]: [f32; 2]) -> Vec3 {
        if self.lens_radius > 0.0 { self.position + self.right * u + self.up * v } else { self.position }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn camera(lens_radius: f32) -> Camera {
        Camera {
            position: Vec3::new(0.1, 0.2, 0.9),
            right: Vec3::X,
            up: Vec3::Y,
            forward: -Vec3::Z,
            half_extent: [0.4, 0.3],
            size: [80, 60],
            lens_radius,
            focus_distance: 0.7,
        }
    }

    /// A point on a ray is seen where the ray came from, through the same point of the lens.
    #[test]
    fn connections_invert_rays() {
        for radius in [0.0, 0.05] {
            let camera = camera(radius);
            for i in 0..50 {
                let film = [(i * 37 % 80) as f32 + 0.25, (i * 53 % 60) as f32 + 0.75];
                let lens = [(i as f32 * 0.317).fract(), (i as f32 * 0.719).fract()];
                let ray = camera.ray(film, lens);
                let seen = camera.connect(ray.at(0.3 + 0.01 * i as f32), lens, 0.0).unwrap();
                assert!((seen.film[0] - film[0]).abs() < 1e-3 && (seen.film[1] - film[1]).abs() < 1e-3);
                assert_eq!(seen.lens, ray.origin);
            }
        }
        assert!(camera(0.0).connect(Vec3::new(0.1, 0.2, 1.0), [0.5; 2], 0.0).is_none());
    }

    /// The first pixel is the top left one.
    #[test]
    fn orientation() {
        let ray = camera(0.0).ray([0.5, 0.5], [0.0; 2]);
        assert!(ray.direction.x < 0.0 && ray.direction.y > 0.0 && ray.direction.z < 0.0);
    }

    /// Σ importance · area · cos over a plane that the film sees whole is the number of pixels.
    #[test]
    fn importance_integrates_to_the_film() {
        let (camera, n) = (camera(0.0), 400);
        let cell = 2.0 / n as f32;
        let mut sum = 0.0;
        for i in 0..n * n {
            let (x, y) = ((i % n) as f32 + 0.5, (i / n) as f32 + 0.5);
            let point = Vec3::new(0.1 + x * cell - 1.0, 0.2 + y * cell - 1.0, 0.0);
            if let Some(seen) = camera.connect(point, [0.0; 2], 0.0) {
                let to_camera = (seen.lens - point).normalize();
                sum += f64::from(seen.importance * to_camera.z * cell * cell);
            }
        }
        assert!((sum / 4800.0 - 1.0).abs() < 0.01, "{sum}");
    }
}
