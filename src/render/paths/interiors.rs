//! The transparent objects that a path is inside of.

use crate::scene::{MediumId, ObjectId, Scene, Surface};
use glam::Vec3;

/// The transparent objects that hold a point, in the order in which they were entered. Where they overlap, the one of
/// highest priority is there, and of equals the one entered last.
#[derive(Debug, Clone, Default)]
pub struct Interiors {
    entries: Vec<(ObjectId, MediumId)>,
}

impl Interiors {
    /// Starts from a known list.
    pub fn reset(&mut self, entries: &[(ObjectId, MediumId)]) {
        self.entries.clear();
        self.entries.extend_from_slice(entries);
    }

    /// Copies another list.
    pub fn copy_from(&mut self, other: &Self) {
        self.reset(&other.entries);
    }

    /// What is there; `None` is air.
    #[inline]
    pub fn medium(&self, scene: &Scene) -> Option<MediumId> {
        top(scene, self.entries.iter().copied())
    }

    /// Becomes what holds the points just past a surface of a transparent object, for a path that comes from where
    /// `before` holds; `false` when leaving an object that was never entered, which changes nothing.
    pub fn set_past(
        &mut self,
        before: &Self,
        scene: &Scene,
        surface: &Surface,
        medium: MediumId,
        direction: Vec3,
    ) -> bool {
        if scene.object(surface.object).coincident {
            self.reset(&scene.interiors_at(surface.spawn(direction).origin));
            return true;
        }
        self.copy_from(before);
        let inward = surface.geometric.dot(direction.as_dvec3()) < 0.0;
        match self.entries.iter().rposition(|(object, _)| *object == surface.object) {
            // The path set out from what touches the boundary, and is inside already.
            Some(_) if inward && scene.sets_out_in_contact(surface, direction) => {}
            _ if inward => self.entries.push((surface.object, medium)),
            Some(index) => {
                self.entries.remove(index);
            }
            // In the wedge round a point of contact rounding decides on which side of the boundary a path was.
            None => return scene.object(surface.object).touched,
        }
        true
    }
}

fn top(scene: &Scene, entries: impl Iterator<Item = (ObjectId, MediumId)>) -> Option<MediumId> {
    // Of equal maxima `max_by_key` returns the last.
    entries.max_by_key(|(_, medium)| scene.medium(*medium).priority).map(|(_, medium)| medium)
}
