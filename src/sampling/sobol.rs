//! Owen-scrambled Sobol points with random access.
//!
//! Eight dimensions form a *group*: one eight-dimensional Sobol net \[JoeKuo2008\], Owen-scrambled by a hash of its own
//! [LaineKarras2011, Burley2020, Vegdahl2021]. Groups are made independent by scrambling the order of the points as
//! well, so there is no last dimension. An index has 64 bits: every 2³² points the scramble is drawn anew.

use wide::u32x8;

/// Dimensions of a group.
pub const DIMENSIONS: usize = 8;

/// A scrambled sequence. Different seeds give independent randomisations.
#[derive(Debug, Clone, Copy)]
pub struct Sobol {
    seed: u64,
}

impl Sobol {
    /// Makes the sequence of a seed.
    pub fn new(seed: u64) -> Self {
        Self { seed: mix(seed) }
    }

    /// The coordinates of point `index` in the eight dimensions of `group`, each in [0, 1).
    pub fn group(&self, index: u64, group: u32) -> [f32; DIMENSIONS] {
        let epoch = index >> 32;
        let seed = mix(self.seed ^ mix(epoch << 32 | u64::from(group)));
        let shuffled = laine_karras((index as u32).reverse_bits(), seed as u32).reverse_bits();
        let bits = reverse_bits(laine_karras_lanes(sobol_reversed(shuffled), lane_seeds((seed >> 32) as u32)));
        bits.to_array().map(|b| (b >> 8) as f32 * (1.0 / (1 << 24) as f32))
    }
}

/// Mixes 64 bits so that every input bit changes every output bit with probability about one half \[Steele2014\].
pub fn mix(mut x: u64) -> u64 {
    x = x.wrapping_add(0x9e37_79b9_7f4a_7c15);
    x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    x ^ (x >> 31)
}

/// Degree, inner coefficients and first direction numbers of the primitive polynomials of dimensions 1–7 \[JoeKuo2008\];
/// dimension 0 is the van der Corput sequence.
const POLYNOMIALS: [(usize, u32, [u32; 5]); DIMENSIONS - 1] = [
    (1, 0, [1, 0, 0, 0, 0]),
    (2, 1, [1, 3, 0, 0, 0]),
    (3, 1, [1, 3, 1, 0, 0]),
    (3, 2, [1, 1, 1, 0, 0]),
    (4, 1, [1, 1, 3, 3, 0]),
    (4, 4, [1, 3, 5, 13, 0]),
    (5, 2, [1, 1, 5, 5, 17]),
];

/// Direction numbers of one dimension, most significant bit first.
const fn directions(dimension: usize) -> [u32; 32] {
    let mut v = [0u32; 32];
    let mut i = 0;
    if dimension == 0 {
        while i < 32 {
            v[i] = 1 << (31 - i);
            i += 1;
        }
        return v;
    }
    let (degree, inner, first) = POLYNOMIALS[dimension - 1];
    while i < 32 {
        if i < degree {
            v[i] = first[i] << (31 - i);
        } else {
            v[i] = v[i - degree] ^ (v[i - degree] >> degree);
            let mut k = 1;
            while k < degree {
                if (inner >> (degree - 1 - k)) & 1 == 1 {
                    v[i] ^= v[i - k];
                }
                k += 1;
            }
        }
        i += 1;
    }
    v
}

/// For each of the eight nibbles of an index, the XOR of its direction numbers in all dimensions, bit-reversed.
static NIBBLES: [[[u32; DIMENSIONS]; 16]; 8] = {
    let mut table = [[[0u32; DIMENSIONS]; 16]; 8];
    let mut dimension = 0;
    while dimension < DIMENSIONS {
        let v = directions(dimension);
        let mut nibble = 0;
        while nibble < 8 {
            let mut value = 0;
            while value < 16 {
                let mut bit = 0;
                while bit < 4 {
                    if (value >> bit) & 1 == 1 {
                        table[nibble][value][dimension] ^= v[nibble * 4 + bit].reverse_bits();
                    }
                    bit += 1;
                }
                value += 1;
            }
            nibble += 1;
        }
        dimension += 1;
    }
    table
};

/// The unscrambled Sobol point of an index, bit-reversed.
fn sobol_reversed(index: u32) -> u32x8 {
    let mut bits = u32x8::new([0; 8]);
    for (nibble, table) in NIBBLES.iter().enumerate() {
        bits ^= u32x8::new(table[(index >> (4 * nibble)) as usize & 15]);
    }
    bits
}

/// Owen scrambling of a bit-reversed number by a hash in which every bit depends on the lower bits alone \[Vegdahl2021\].
fn laine_karras(mut x: u32, seed: u32) -> u32 {
    x ^= x.wrapping_mul(0x3d20_adea);
    x = x.wrapping_add(seed);
    x = x.wrapping_mul((seed >> 16) | 1);
    x ^= x.wrapping_mul(0x0552_6c56);
    x ^ x.wrapping_mul(0x53a2_2864)
}

/// [`laine_karras`] on eight lanes.
fn laine_karras_lanes(mut x: u32x8, seed: u32x8) -> u32x8 {
    x ^= x * u32x8::splat(0x3d20_adea);
    x += seed;
    x *= (seed >> 16) | u32x8::splat(1);
    x ^= x * u32x8::splat(0x0552_6c56);
    x ^ (x * u32x8::splat(0x53a2_2864))
}

/// Makes eight scramble seeds out of one.
fn lane_seeds(seed: u32) -> u32x8 {
    let mut x = u32x8::splat(seed) + u32x8::new([1, 2, 3, 4, 5, 6, 7, 8]) * u32x8::splat(0x9e37_79b9);
    x ^= x >> 16;
    x *= u32x8::splat(0x85eb_ca6b);
    x ^= x >> 13;
    x *= u32x8::splat(0xc2b2_ae35);
    x ^ (x >> 16)
}

/// Reverses the bits of every lane.
fn reverse_bits(mut x: u32x8) -> u32x8 {
    for (shift, mask) in [(1, 0x5555_5555u32), (2, 0x3333_3333), (4, 0x0f0f_0f0f), (8, 0x00ff_00ff)] {
        let mask = u32x8::splat(mask);
        x = ((x >> shift) & mask) | ((x & mask) << shift);
    }
    (x >> 16) | (x << 16)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lanes_match_the_scalar_scramble() {
        for x in (0..100u32).map(|i| mix(u64::from(i)) as u32) {
            let seeds = lane_seeds(x);
            let lanes = reverse_bits(laine_karras_lanes(sobol_reversed(x), seeds)).to_array();
            for ((lane, plain), seed) in lanes.into_iter().zip(sobol_reversed(x).to_array()).zip(seeds.to_array()) {
                assert_eq!(lane, laine_karras(plain, seed).reverse_bits());
            }
        }
    }

    /// Every dimension of 2^m points has one point in each of 2^m equal intervals: Owen scrambling keeps the net.
    #[test]
    fn every_dimension_is_stratified() {
        let sobol = Sobol::new(7);
        for group in [0, 1, 17] {
            let mut seen = vec![[false; 1 << 12]; DIMENSIONS];
            for i in 0..1u64 << 12 {
                for (dimension, x) in sobol.group(i, group).into_iter().enumerate() {
                    let cell = (x * 4096.0) as usize;
                    assert!(!std::mem::replace(&mut seen[dimension][cell], true), "dimension {dimension} cell {cell}");
                }
            }
        }
    }

    /// The first two dimensions form a (0, m, 2)-net: every elementary interval of area 2^-m holds one point.
    #[test]
    fn the_first_two_dimensions_are_a_net() {
        let sobol = Sobol::new(3);
        let m = 10;
        let points: Vec<_> = (0..1u64 << m).map(|i| sobol.group(i, 2)).collect();
        for a in 0..=m {
            let mut seen = vec![false; 1 << m];
            for p in &points {
                let x = (p[0] * (1u32 << a) as f32) as usize;
                let y = (p[1] * (1u32 << (m - a)) as f32) as usize;
                assert!(!std::mem::replace(&mut seen[x << (m - a) | y], true));
            }
        }
    }

    /// Good past 2^16 points: the error of a smooth integral keeps falling much faster than 1/√N.
    #[test]
    fn error_keeps_falling_past_2_to_the_16() {
        let f = |p: [f32; 8]| p[..4].iter().map(|&x| 1.0 + 0.5 * (f64::from(x) - 0.5)).product::<f64>();
        let rms = |n: u64| {
            let errors = (0..4u64).map(|seed| {
                let sobol = Sobol::new(seed);
                (0..n).map(|i| f(sobol.group(i, 5))).sum::<f64>() / n as f64 - 1.0
            });
            (errors.map(|e| e * e).sum::<f64>() / 4.0).sqrt()
        };
        let (coarse, fine) = (rms(1 << 12), rms(1 << 18));
        // 4σ/√N of random points would be 2e-3 and 3e-4; the floor is the 24 bits of an f32.
        assert!(coarse < 5e-6 && fine < 1.5e-7, "{coarse:e} -> {fine:e}");
    }

    #[test]
    fn the_index_has_64_bits() {
        let sobol = Sobol::new(1);
        assert_ne!(sobol.group(5, 0), sobol.group(5 + (1 << 32), 0));
        assert_ne!(sobol.group(5, 0), sobol.group(5, 1));
    }
}
