//! A vertex of a path, and what can become of a path at one.

use crate::bsdf::Bsdf;
use crate::geometry::Frame;
use crate::scene::Surface;
use glam::Vec3;

/// A place where a path is scattered.
#[derive(Debug)]
pub struct Vertex<'s> {
    /// The point and its surface.
    pub surface: &'s Surface,
    /// How the surface scatters, at the path's wavelengths.
    pub bsdf: Bsdf,
    /// The normals, turned to the path.
    pub frame: Frame,
    /// Direction towards where the path came from.
    pub wo: Vec3,
    /// Whether the material counts as focusing light; see [`crate::scene::Material::focuses`].
    pub focuses: bool,
    /// Whether the path had entered the object that it leaves here, if it leaves one.
    pub(super) entered: bool,
}

impl Vertex<'_> {
    /// Whether what leaves the vertex can make a glossy caustic: a rough surface that focuses.
    pub fn is_glossy(&self) -> bool {
        self.bsdf.is_rough() && self.focuses
    }
}

/// What a path finds at the end of its ray.
///
/// Scattering media are to become vertices too: [`super::Walk::advance`] draws the distance of an event, and this enum gets
/// a variant for it.
#[allow(clippy::large_enum_variant, reason = "one at a time lives on the stack of a loop: a box would be slower")]
#[derive(Debug)]
pub enum Encounter<'s> {
    /// A surface that scatters.
    Vertex(Vertex<'s>),
    /// A boundary that is optically absent; the path is past it.
    Passed,
    /// A surface that takes all light.
    Absorbed,
}

/// What becomes of a path that is scattered.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Scattering {
    /// It ends.
    Ended,
    /// It goes on along its ray, whose direction was drawn with this density in solid angle; `None` for a delta.
    Along(Option<f32>),
    /// Its lanes have parted: follow each by [`super::Walk::each_way`].
    Parted,
}
