//! Which mechanisms rendering a scene needs: derived from the compiled scene, never asked of the user.

/// Mechanisms that a scene can do without. Each picks a kernel in which its absence costs nothing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SceneFeatures {
    /// Some medium's index depends on the wavelength: lanes can part.
    pub dispersion: bool,
    /// There are transparent volumes: a path knows what it is inside of.
    pub interiors: bool,
}
