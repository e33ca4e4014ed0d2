//! The geometry of pixels and tiles. A tile is the square of pixels that one thread works on at a time.

use crate::scene::FilmSettings;
use std::ops::Range;

/// Edge of a tile in pixels.
const TILE: u32 = 16;

/// Returns the numbers of all tiles of a picture.
pub fn tiles(film: &FilmSettings) -> Range<u32> {
    0..film.width.div_ceil(TILE) * film.height.div_ceil(TILE)
}

/// Returns the pixels of a tile, row by row.
pub fn tile_pixels(tile: u32, width: u32, height: u32) -> impl Iterator<Item = u32> {
    let tiles_across = width.div_ceil(TILE);
    let (x0, y0) = (tile % tiles_across * TILE, tile / tiles_across * TILE);
    let (x1, y1) = ((x0 + TILE).min(width), (y0 + TILE).min(height));
    (y0..y1).flat_map(move |y| (x0..x1).map(move |x| y * width + x))
}

/// Returns rows and columns of each tile, where tiles cover the picture and `reach` pixels beyond it on each side.
pub fn camera_tiles(film: &FilmSettings, reach: u32) -> Vec<[Range<i32>; 2]> {
    let reach = reach as i32;
    let parts = |size: u32| -> Vec<Range<i32>> {
        let end = size as i32 + reach;
        (-reach..end).step_by(TILE as usize).map(|first| first..(first + TILE as i32).min(end)).collect()
    };
    let columns = parts(film.width);
    parts(film.height).iter().flat_map(|rows| columns.iter().map(|c| [rows.clone(), c.clone()])).collect()
}

/// Returns the index of a pixel, or `None` if it lies beyond the film.
pub fn on_film(film: &FilmSettings, [x, y]: [i32; 2]) -> Option<usize> {
    let (width, height) = (film.width as i32, film.height as i32);
    ((0..width).contains(&x) && (0..height).contains(&y)).then(|| (y * width + x) as usize)
}

/// Returns column and row of a pixel of the film.
pub fn column_and_row(film: &FilmSettings, pixel: u32) -> [i32; 2] {
    [pixel % film.width, pixel / film.width].map(|c| c as i32)
}

/// Returns the number of a pixel among those of the film and those beyond it that the filter reaches.
pub fn square(film: &FilmSettings, [x, y]: [i32; 2]) -> u64 {
    let reach = film.filter.reach() as i32;
    (y + reach) as u64 * (u64::from(film.width) + 2 * reach as u64) + (x + reach) as u64
}
