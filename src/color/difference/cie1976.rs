//! CIE 1976: the distance in L\*a\*b\*.

use glam::DVec3;

/// ΔE\*ab of two CIE Lab colours \[CIE15\]. Symmetric.
pub fn cie1976(lab_1: DVec3, lab_2: DVec3) -> f64 {
    lab_1.distance(lab_2)
}
