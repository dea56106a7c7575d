//! A sphere with a smooth texture for every map, made when the test runs.
#![allow(clippy::unwrap_used)]

use image::{Rgb, RgbImage};
use std::f64::consts::{PI, TAU};
use std::fmt::Write;
use std::path::{Path, PathBuf};

const SIZE: u32 = 64;

/// Writes a model with `map_Kd map_Ks map_Ke map_Ns map_d`; returns its path.
pub fn write(folder: &Path) -> PathBuf {
    for (name, phase) in [("kd", 0.0), ("ks", 1.0), ("ke", 2.0), ("ns", 3.0), ("d", 4.0)] {
        // Smooth, so that 8-bit filter weights and 1/256 of a pixel do not matter.
        let low = match name {
            "d" | "ns" => 0.6,
            "ke" => 0.0,
            _ => 0.2,
        };
        let high = if name == "ke" { 0.3 } else { 1.0 };
        RgbImage::from_fn(SIZE, SIZE, |x, y| {
            let wave = |k: f64| {
                let (u, v) = (f64::from(x) / f64::from(SIZE), f64::from(y) / f64::from(SIZE));
                let w = 0.5 + 0.06 * (TAU * u + phase + k).sin() + 0.06 * (TAU * v - phase + 2.0 * k).cos();
                (255.0 * (low + (high - low) * w)).round() as u8
            };
            Rgb([wave(0.0), wave(1.0), wave(2.0)])
        })
        .save(folder.join(format!("{name}.png")))
        .unwrap();
    }
    let material = "newmtl all\nKd 1 1 1\nKs 0.6 0.6 0.6\nKe 1 1 1\nNs 40\nmap_Kd kd.png\nmap_Ks ks.png\n\
                    map_Ke ke.png\nmap_Ns ns.png\nmap_d d.png\n";
    write_sphere(folder, material)
}

/// Writes a model with a normal map and a colour map; returns its path.
pub fn write_with_normal_map(folder: &Path) -> PathBuf {
    RgbImage::from_fn(SIZE, SIZE, |x, y| {
        let (u, v) = (f64::from(x) / f64::from(SIZE), f64::from(y) / f64::from(SIZE));
        let (nx, ny) = (0.3 * (2.0 * TAU * u).sin(), 0.3 * (2.0 * TAU * v).cos());
        let nz = (1.0 - nx * nx - ny * ny).sqrt();
        Rgb([nx, ny, nz].map(|n| (255.0 * (0.5 + 0.5 * n)).round() as u8))
    })
    .save(folder.join("normal.png"))
    .unwrap();
    write_sphere(folder, "newmtl bumpy\nKd 0.7 0.6 0.5\nKs 0.3 0.3 0.3\nNs 20\nnorm normal.png\n")
}

/// The belt of a sphere of radius 1 with texture coordinates and exact normals.
fn write_sphere(folder: &Path, material: &str) -> PathBuf {
    let (rows, columns) = (16, 24);
    let name = material.split_whitespace().nth(1).unwrap();
    let mut text = format!("mtllib sphere.mtl\nusemtl {name}\n");
    for row in 0..=rows {
        let theta = PI * f64::from(row) / f64::from(rows);
        for column in 0..=columns {
            let phi = TAU * f64::from(column) / f64::from(columns);
            let n = [theta.sin() * phi.sin(), theta.cos(), theta.sin() * phi.cos()];
            writeln!(text, "v {} {} {}\nvn {} {} {}", n[0], n[1], n[2], n[0], n[1], n[2]).unwrap();
            let (u, v) = (f64::from(column) / f64::from(columns), 1.0 - f64::from(row) / f64::from(rows));
            writeln!(text, "vt {u} {v}").unwrap();
        }
    }
    let corner = |row: i32, column: i32| {
        let i = row * (columns + 1) + column + 1;
        format!("{i}/{i}/{i}")
    };
    // Without its caps: towards the poles u changes ever faster, and 1/256 of a pixel is much of it.
    for row in 3..rows - 3 {
        for column in 0..columns {
            let [a, b, c, d] =
                [(row, column), (row + 1, column), (row + 1, column + 1), (row, column + 1)].map(|(r, c)| corner(r, c));
            writeln!(text, "f {a} {b} {c} {d}").unwrap();
        }
    }
    std::fs::write(folder.join("sphere.mtl"), material).unwrap();
    let path = folder.join("sphere.obj");
    std::fs::write(&path, text).unwrap();
    path
}
