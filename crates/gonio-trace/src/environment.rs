//! Light from all directions: an environment, sampled where it is bright.

use crate::sampling::Discrete;
use glam::{DVec3, Vec2, Vec3};
use gonio_environment::Cubemap;
use gonio_scene::{LoadedEnvironment, Surroundings};
use rayon::prelude::*;
use std::f32::consts::{PI, TAU};
use std::sync::Arc;

/// Columns of the grid over all directions.
const COLUMNS: usize = 512;
/// Rows, of equal height along the vertical axis: all cells have the same solid angle.
const ROWS: usize = 256;
/// Solid angle of a cell, sr.
const CELL: f32 = 2.0 * TAU / (COLUMNS * ROWS) as f32;

/// An environment that lights the scene.
pub(crate) struct Environment {
    loaded: Arc<LoadedEnvironment>,
    surroundings: Surroundings,
    /// Over the cells, by radiance; directions of the environment.
    cells: Discrete,
    /// The mean radiance, linear RGB.
    pub mean: DVec3,
}

impl Environment {
    pub fn new(loaded: Arc<LoadedEnvironment>, surroundings: Surroundings) -> Self {
        let by_cell = radiance_by_cell(loaded.mips.full());
        let cells = Discrete::new(spread(&by_cell));
        let mut mean = loaded.mips.full().mean_radiance() * surroundings.intensity;
        if !mean.is_finite() {
            // Without the texels that are not.
            let sum = by_cell.iter().sum::<f64>() / (3.0 * 2.0 * std::f64::consts::TAU);
            mean = DVec3::splat(sum * surroundings.intensity);
        }
        Environment { loaded, surroundings, cells, mean }
    }

    /// Radiance from a direction of the world, linear RGB; 0 where it is not finite.
    pub fn radiance(&self, direction: Vec3) -> Vec3 {
        let d = self.surroundings.environment_from_world * direction.as_dvec3();
        let radiance = (self.loaded.mips.full().sample(d) * self.surroundings.intensity).as_vec3();
        if radiance.is_finite() { radiance.max(Vec3::ZERO) } else { Vec3::ZERO }
    }

    /// A direction of the world with its density, in 1/sr.
    pub fn sample(&self, u: Vec2) -> Option<(Vec3, f32)> {
        let (cell, probability, rest) = self.cells.sample(u.x)?;
        let (column, row) = (cell % COLUMNS, cell / COLUMNS);
        let d = direction_of(column as f64 + f64::from(rest), row as f64 + f64::from(u.y));
        let world = self.surroundings.environment_from_world.transpose() * d;
        Some((world.as_vec3().normalize(), probability / CELL))
    }

    /// The density with which [`Self::sample`] finds a direction of the world, in 1/sr.
    pub fn density(&self, direction: Vec3) -> f32 {
        if self.cells.is_empty() {
            return 0.0;
        }
        let d = self.surroundings.environment_from_world * direction.as_dvec3();
        self.cells.probability(cell_of(d)) / CELL
    }
}

fn cell_of(d: DVec3) -> usize {
    let turn = (d.z.atan2(d.x) as f32 + PI) / TAU;
    let column = ((turn * COLUMNS as f32) as usize).min(COLUMNS - 1);
    let row = ((0.5 - 0.5 * d.y as f32) * ROWS as f32).clamp(0.0, (ROWS - 1) as f32) as usize;
    row * COLUMNS + column
}

/// The direction at a place of the grid: `column` in `[0, COLUMNS]`, `row` in `[0, ROWS]`.
fn direction_of(column: f64, row: f64) -> DVec3 {
    let height = 1.0 - 2.0 * row / ROWS as f64;
    let (sin, cos) = (std::f64::consts::TAU * column / COLUMNS as f64 - std::f64::consts::PI).sin_cos();
    let across = (1.0 - height * height).max(0.0).sqrt();
    DVec3::new(across * cos, height, across * sin)
}

/// Radiance times solid angle by cell. Where texels are smaller than cells every one of them counts, however small and
/// bright; where they are larger, cells are looked up.
fn radiance_by_cell(map: &Cubemap) -> Vec<f64> {
    let light_of = |texel: DVec3| {
        let light = texel.max(DVec3::ZERO).element_sum();
        if light.is_finite() { light } else { 0.0 }
    };
    let size = map.size();
    if (size as usize).pow(2) * 6 < 4 * COLUMNS * ROWS {
        return (0..COLUMNS * ROWS)
            .into_par_iter()
            .map(|i| {
                let (column, row) = ((i % COLUMNS) as f64, (i / COLUMNS) as f64);
                // Centre and corners: the edge of something bright passes between them.
                [(0.5, 0.5), (0.1, 0.1), (0.9, 0.1), (0.1, 0.9), (0.9, 0.9)]
                    .map(|(x, y)| light_of(map.sample(direction_of(column + x, row + y))))
                    .iter()
                    .sum::<f64>()
                    * f64::from(CELL)
                    / 5.0
            })
            .collect();
    }
    let mut cells = vec![0.0; COLUMNS * ROWS];
    for face in gonio_environment::Face::ALL {
        for y in 0..size {
            for x in 0..size {
                let d = gonio_environment::cubemap::texel_direction(face, x, y, size);
                // The solid angle of a texel falls with the cube of its distance from the eye.
                let solid_angle = 4.0 / f64::from(size).powi(2) * d.abs().max_element().powi(3);
                cells[cell_of(d)] += light_of(map.texel(face, x.into(), y.into())) * solid_angle;
            }
        }
    }
    cells
}

/// Shares each cell with its neighbours: texels are blended into each other.
fn spread(cells: &[f64]) -> Vec<f64> {
    let mean = cells.iter().sum::<f64>() / cells.len() as f64;
    (0..cells.len())
        .map(|i| {
            let (column, row) = (i % COLUMNS, i / COLUMNS);
            let mut sum = 0.0;
            for (dy, wy) in [(-1_i64, 0.25), (0, 0.5), (1, 0.25)] {
                let y = (row as i64 + dy).clamp(0, ROWS as i64 - 1) as usize;
                for (dx, wx) in [(COLUMNS - 1, 0.25), (0, 0.5), (1, 0.25)] {
                    sum += wy * wx * cells[y * COLUMNS + (column + dx) % COLUMNS];
                }
            }
            // No direction with light may have the density 0.
            sum + 0.02 * mean
        })
        .collect()
}
