//! The indices by which the parts of a compiled scene refer to each other. Each is a type of its own, so that the index of
//! one table is never looked up in another.

/// Index into [`Scene::objects`](crate::scene::Scene::objects).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct ObjectId(pub u32);

/// Index into [`Scene::lights`](crate::scene::Scene::lights).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct LightId(pub u32);

/// Index into [`Scene::spectra`](crate::scene::Scene::spectra).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct SpectrumId(pub u32);

/// Index into [`Scene::media`](crate::scene::Scene::media).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct MediumId(pub u32);

impl ObjectId {
    /// The index of no object, of points that lie on none.
    pub(super) const NONE: Self = Self(u32::MAX);
}
