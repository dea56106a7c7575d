//! Which shadow maps a frame needs: one of a directional light or a narrow spot, up to six of a point light or a wide
//! spot, all in one texture. Only geometry, no OpenGL.
//!
//! A map covers what its light can light of the box around all objects. Where its texels would be coarser than pixels, and
//! light is summed at fragments, it covers only what the camera sees of that.

use glam::{DMat4, DVec2, DVec3, DVec4};
use gonio_light::{Light, LightKind, vector};
use gonio_scene::Frame;

/// Most lights that cast shadows, the first of a scene: each may need six maps.
pub const MOST_SHADOWED_LIGHTS: usize = 16;
/// Texels of one shadow map in the table of shadow maps.
pub const SHADOW_TEXELS: usize = 6;
/// Rows of the table of shadow maps: six for each light.
pub const SHADOW_ROWS: usize = 6 * MOST_SHADOWED_LIGHTS;
/// Texels of all maps together: 64 MiB.
const MOST_TEXELS: f64 = (1_u32 << 24) as f64;
/// Texels along a side of a map; twice the pixels of the picture, within these limits.
const SIDES: [u32; 2] = [512, 4096];
/// Half angle of a spot's cone up to which one map covers it, radians. A wider one needs the sides of a cube.
const NARROW_RAD: f64 = 1.05;
/// A light's near plane, as a share of the distance of its far plane: what is nearer to the light casts no shadow.
const NEAREST: f64 = 1e-3;
/// Steps along a side of the whole map to which a part of it is aligned, so that small movements of the camera keep it.
const STEPS: f64 = 16.0;
/// Rounding errors of positions in f32 that a map must not take for shadows, as a share of the coordinates.
const ROUNDING: f64 = 5e-7;

/// The picture that a light takes: orthographic or perspective, part of its plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShadowMap {
    right: DVec3,
    up: DVec3,
    front: DVec3,
    /// The light, or any point for a directional light.
    origin: DVec3,
    perspective: bool,
    /// Least and greatest corner of the part that is drawn: world units, or at distance 1 along `front`.
    window: [DVec2; 2],
    near: f64,
    far: f64,
    /// World units; depths that differ less are equal.
    bias: f64,
}

/// The maps of a frame and their places in the texture.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ShadowPlan {
    /// The rows of the table; `None` for sides of a cube in which nothing is lit.
    pub maps: Vec<Option<ShadowMap>>,
    /// First row and number of rows of each light of the frame; none for lights without shadows.
    pub rows: Vec<[usize; 2]>,
    /// Texels along a side of each map.
    pub side: u32,
    /// Maps beside each other in the texture.
    pub columns: u32,
    /// Lights that cast no shadows though they should.
    pub unshadowed: usize,
}

impl ShadowPlan {
    /// Plans the maps of a frame's lights. `at_vertices`: light is also summed at vertices that the camera does not see.
    pub fn new(frame: &Frame, max_size: u32, at_vertices: bool) -> Self {
        let mut plan = ShadowPlan { rows: vec![[0; 2]; frame.lights.len()], ..ShadowPlan::default() };
        let bounds = [frame.bounds_min, frame.bounds_max];
        if !frame.shadows || !bounds.iter().all(|b| b.is_finite()) {
            return plan;
        }
        let shines = |light: &Light| light.color != DVec3::ZERO && !matches!(light.kind, LightKind::Ambient);
        let mut candidates: Vec<(Option<Candidate>, usize)> = Vec::new();
        let boxed = box_faces(bounds);
        let mut count = 0;
        for (index, light) in frame.lights.iter().enumerate().filter(|(_, light)| shines(light)) {
            if count == MOST_SHADOWED_LIGHTS {
                plan.unshadowed += 1;
                continue;
            }
            count += 1;
            let cameras = Candidate::of_light(light, bounds);
            plan.rows[index] = [candidates.len(), cameras.len()];
            candidates.extend(cameras.into_iter().map(|c| (c.and_then(|c| c.framed(&boxed)), index)));
        }
        let drawn = candidates.iter().filter(|(map, _)| map.is_some()).count().max(1);
        plan.columns = (drawn as f64).sqrt().ceil() as u32;
        let wanted = (2 * frame.width.max(frame.height)).next_power_of_two().clamp(SIDES[0], SIDES[1]);
        let affordable =
            (MOST_TEXELS / (f64::from(plan.columns) * (drawn as f64 / f64::from(plan.columns)).ceil())).sqrt();
        plan.side = wanted.min(affordable as u32).min(max_size / plan.columns).max(1);
        let side = f64::from(plan.side);
        let seen = if at_vertices { Vec::new() } else { seen_faces(frame, bounds) };
        plan.maps = candidates
            .into_iter()
            .map(|(candidate, _)| {
                let whole = candidate?;
                if at_vertices || whole.texel(side) <= pixel_at(frame, &seen) {
                    return Some(whole.map(side));
                }
                Some(whole.part(&seen)?.map(side))
            })
            .collect();
        plan
    }

    /// Whether any map is drawn.
    pub fn is_empty(&self) -> bool {
        self.maps.iter().all(Option::is_none)
    }

    /// Drawn maps with their rows and the places of their first texels.
    pub fn drawn(&self) -> impl Iterator<Item = (usize, ShadowMap, [u32; 2])> {
        let maps = self.maps.iter().enumerate().filter_map(|(row, map)| map.map(|map| (row, map)));
        maps.enumerate().map(|(place, (row, map))| {
            let place = place as u32;
            (row, map, [place % self.columns * self.side, place / self.columns * self.side])
        })
    }

    /// Width and height of the texture.
    pub fn size(&self) -> [u32; 2] {
        let drawn = self.maps.iter().flatten().count() as u32;
        [self.columns.min(drawn) * self.side, drawn.div_ceil(self.columns.max(1)) * self.side]
    }

    /// The table that shadow.glsl reads, `SHADOW_ROWS` rows of `SHADOW_TEXELS` texels. Maps that are not drawn have no
    /// texels: their least texel is beyond their greatest.
    pub fn table(&self) -> Vec<[[f32; 4]; SHADOW_TEXELS]> {
        let mut rows = vec![[[0.0, 0.0, 0.0, 1.0]; SHADOW_TEXELS]; SHADOW_ROWS];
        for row in &mut rows {
            row[SHADOW_TEXELS - 1] = [1.0, 1.0, 0.0, 0.0];
        }
        for (row, map, place) in self.drawn() {
            if let Some(slot) = rows.get_mut(row) {
                *slot = map.row(place, self.side);
            }
        }
        rows
    }
}

impl ShadowMap {
    /// From the world to the clip space of the map's picture.
    pub fn clip_from_world(&self) -> DMat4 {
        let [low, high] = self.window;
        let (middle, half) = (0.5 * (low + high), 0.5 * (high - low));
        let (near, far) = (self.near, self.far);
        let axis = |v: DVec3| v.extend(-v.dot(self.origin));
        let (right, up, front) = (axis(self.right), axis(self.up), axis(self.front));
        let one = DVec4::W;
        let (away, w) = if self.perspective { (front, front) } else { (one, one) };
        let depth = if self.perspective {
            ((far + near) * front - 2.0 * far * near * one) / (far - near)
        } else {
            (2.0 * front - (far + near) * one) / (far - near)
        };
        let rows = [(right - middle.x * away) / half.x, (up - middle.y * away) / half.y, depth, w];
        DMat4::from_cols(rows[0], rows[1], rows[2], rows[3]).transpose()
    }

    fn row(&self, place: [u32; 2], side: u32) -> [[f32; 4]; SHADOW_TEXELS] {
        let [low, high] = self.window;
        let place = DVec2::from(place.map(f64::from));
        let scale = DVec2::splat(side.into()) / (high - low);
        let offset = place - low * scale;
        let texel = |v: DVec3, w: f64| v.extend(w).as_vec4().to_array();
        let last = place + DVec2::splat(f64::from(side) - 1.0);
        [
            texel(self.right, scale.x),
            texel(self.up, scale.y),
            texel(self.front, if self.perspective { 1.0 } else { 0.0 }),
            texel(self.origin, self.bias),
            DVec4::new(offset.x, offset.y, self.near, self.far).as_vec4().to_array(),
            DVec4::new(place.x, place.y, last.x, last.y).as_vec4().to_array(),
        ]
    }
}

/// A convex polygon in the world.
type Polygon = Vec<DVec3>;

/// A map before its window is known.
#[derive(Clone, Copy)]
struct Candidate {
    map: ShadowMap,
    /// Half the field of view of a perspective picture, as a tangent.
    tangent: f64,
}

impl Candidate {
    /// The cameras of a light: one, or the six sides of a cube in the order +X, -X, +Y, -Y, +Z, -Z of shadow.glsl. `None` for
    /// a side that the cone of a spot does not reach.
    fn of_light(light: &Light, bounds: [DVec3; 2]) -> Vec<Option<Candidate>> {
        match light.kind {
            LightKind::Ambient => Vec::new(),
            LightKind::Directional { direction } => match vector::unit(direction) {
                Some(front) => vec![Self::looking(front, 0.5 * (bounds[0] + bounds[1]), None, bounds)],
                None => Vec::new(),
            },
            LightKind::Spot { position, axis, outer_rad, .. } if outer_rad < NARROW_RAD => {
                let tangent = outer_rad.max(1e-3).tan();
                vec![vector::unit(axis).and_then(|front| Self::looking(front, position, Some(tangent), bounds))]
            }
            LightKind::Point { position } | LightKind::Spot { position, .. } => {
                let sides = DVec3::AXES.into_iter().flat_map(|axis| [axis, -axis]);
                let reached = |front: DVec3| match light.kind {
                    // From its axis to a corner a side covers the angle whose cosine is the root of 1/3.
                    LightKind::Spot { axis, outer_rad, .. } => vector::unit(axis).is_none_or(|axis| {
                        axis.dot(front).clamp(-1.0, 1.0).acos() <= outer_rad + (1.0_f64 / 3.0).sqrt().acos()
                    }),
                    _ => true,
                };
                sides
                    .map(|front| {
                        let side = || Self::looking(front, position, Some(1.0), bounds);
                        reached(front).then(side).flatten()
                    })
                    .collect()
            }
        }
    }

    fn looking(front: DVec3, origin: DVec3, tangent: Option<f64>, bounds: [DVec3; 2]) -> Option<Candidate> {
        let right = vector::any_orthonormal_vector(front);
        let depths = corners(bounds).map(|corner| (corner - origin).dot(front));
        let (low, high) = depths.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), d| (l.min(*d), h.max(*d)));
        let reach = (bounds[1] - bounds[0]).length().max(1e-9);
        let (near, far) = match tangent {
            // A little more on both sides, so that surfaces on the box are within.
            None => (low - 0.01 * reach, high + 0.01 * reach),
            Some(_) => {
                let far = high + 0.01 * reach;
                ((low - 0.01 * reach).max(NEAREST * far), far)
            }
        };
        if !(far.is_finite() && far > near && (tangent.is_none() || far > 0.0)) {
            return None;
        }
        let largest = bounds.iter().map(|b| b.abs().max_element()).fold(origin.abs().max_element(), f64::max);
        let map = ShadowMap {
            right,
            up: right.cross(front),
            front,
            origin,
            perspective: tangent.is_some(),
            window: [DVec2::ZERO; 2],
            near,
            far,
            bias: ROUNDING * largest,
        };
        Some(Candidate { map, tangent: tangent.unwrap_or(0.0) })
    }

    /// The part of the picture's plane that polygons cover, as far as the light reaches them.
    fn window_of(&self, faces: &[Polygon]) -> Option<[DVec2; 2]> {
        let map = &self.map;
        let (mut low, mut high) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
        for face in faces {
            let mut face: Polygon = face
                .iter()
                .map(|p| p - map.origin)
                .map(|p| DVec3::new(p.dot(map.right), p.dot(map.up), p.dot(map.front)))
                .collect();
            if map.perspective {
                let t = self.tangent;
                let sides = [
                    DVec3::new(-1.0, 0.0, t),
                    DVec3::new(1.0, 0.0, t),
                    DVec3::new(0.0, -1.0, t),
                    DVec3::new(0.0, 1.0, t),
                ];
                face = sides.iter().fold(face, |face, side| clipped(&face, *side, 0.0));
                face = clipped(&face, DVec3::Z, -1e-6 * map.far);
            }
            for p in face {
                let p = p.truncate() / if map.perspective { p.z } else { 1.0 };
                (low, high) = (low.min(p), high.max(p));
            }
        }
        (low.is_finite() && high.is_finite()).then_some([low, high])
    }

    /// The camera of all that it lights.
    fn framed(mut self, boxed: &[Polygon]) -> Option<Candidate> {
        self.map.window = self.window_of(boxed)?;
        Some(self)
    }

    /// The camera of a part, aligned to steps of the whole.
    fn part(mut self, seen: &[Polygon]) -> Option<Candidate> {
        let [from, to] = self.map.window;
        let [low, high] = self.window_of(seen)?;
        let step = ((to - from) / STEPS).max(DVec2::splat(1e-12));
        let aligned = [from + ((low - from) / step).floor() * step, from + ((high - from) / step).ceil() * step];
        self.map.window = [aligned[0].max(from), aligned[1].min(to)];
        Some(self)
    }

    /// The width of a texel in the world, at the far plane.
    fn texel(&self, side: f64) -> f64 {
        let [low, high] = self.map.window;
        (high - low).max_element() / side * if self.map.perspective { self.map.far } else { 1.0 }
    }

    /// The map with a margin of two texels, and never without an extent.
    fn map(&self, side: f64) -> ShadowMap {
        let [low, high] = self.map.window;
        let least = if self.map.perspective { 1e-6 } else { 1e-6 * (self.map.far - self.map.near) };
        let half = (0.5 * (high - low)).max(DVec2::splat(least)) * (1.0 + 4.0 / side);
        let middle = 0.5 * (low + high);
        ShadowMap { window: [middle - half, middle + half], ..self.map }
    }
}

fn corners([low, high]: [DVec3; 2]) -> [DVec3; 8] {
    std::array::from_fn(|i| {
        let pick = |bit: usize, axis: usize| if i & bit == 0 { low[axis] } else { high[axis] };
        DVec3::new(pick(1, 0), pick(2, 1), pick(4, 2))
    })
}

fn box_faces(bounds: [DVec3; 2]) -> Vec<Polygon> {
    let c = corners(bounds);
    [[0, 2, 6, 4], [1, 3, 7, 5], [0, 1, 5, 4], [2, 3, 7, 6], [0, 1, 3, 2], [4, 5, 7, 6]]
        .map(|face| face.map(|i: usize| c[i]).to_vec())
        .to_vec()
}

/// The faces of what the camera sees of a box.
fn seen_faces(frame: &Frame, bounds: [DVec3; 2]) -> Vec<Polygon> {
    let camera = &frame.camera;
    let half = (0.5 * camera.fov_y_rad).tan() * DVec2::new(f64::from(frame.width) / f64::from(frame.height), 1.0);
    let far = corners(bounds).iter().map(|c| (c - camera.position).dot(camera.front)).fold(camera.near, f64::max);
    let at = |x: f64, y: f64, z: f64| {
        camera.position + z * (camera.front + x * half.x * camera.right + y * half.y * camera.up)
    };
    let (near, ring) = (camera.near, [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]]);
    let sides = (0..4).map(|i| {
        let ([a, b], [c, d]) = (ring[i], ring[(i + 1) % 4]);
        vec![at(a, b, near), at(c, d, near), at(c, d, far), at(a, b, far)]
    });
    let front = ring.map(|[x, y]| at(x, y, near)).to_vec();
    let [low, high] = bounds;
    let within_box = sides.chain([front]).map(|face| {
        DVec3::AXES
            .into_iter()
            .fold(face, |face, axis| clipped(&clipped(&face, axis, -axis.dot(low)), -axis, axis.dot(high)))
    });
    let planes = [
        camera.front * half.x - camera.right,
        camera.front * half.x + camera.right,
        camera.front * half.y - camera.up,
        camera.front * half.y + camera.up,
    ];
    let within_view = box_faces(bounds).into_iter().map(|face| {
        let face = planes.iter().fold(face, |face, side| clipped(&face, *side, -side.dot(camera.position)));
        clipped(&face, camera.front, -camera.front.dot(camera.position) - near)
    });
    within_box.chain(within_view).filter(|face| !face.is_empty()).collect()
}

/// The part of a polygon where `normal . p + d >= 0`.
fn clipped(face: &[DVec3], normal: DVec3, d: f64) -> Polygon {
    let side = |p: DVec3| normal.dot(p) + d;
    let mut kept = Vec::with_capacity(face.len() + 1);
    for (i, &p) in face.iter().enumerate() {
        let q = face[(i + 1) % face.len()];
        let (a, b) = (side(p), side(q));
        if a >= 0.0 {
            kept.push(p);
        }
        if (a >= 0.0) != (b >= 0.0) {
            kept.push(p.lerp(q, a / (a - b)));
        }
    }
    kept
}

/// The width of a pixel in the world, at the nearest surface that may be seen.
fn pixel_at(frame: &Frame, seen: &[Polygon]) -> f64 {
    let camera = &frame.camera;
    let nearest = seen.iter().flatten().map(|p| (p - camera.position).dot(camera.front)).fold(f64::INFINITY, f64::min);
    let distance = if nearest.is_finite() { nearest.max(camera.near) } else { camera.near };
    distance * 2.0 * (0.5 * camera.fov_y_rad).tan() / f64::from(frame.height)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plan(light: LightKind, at_vertices: bool) -> ShadowPlan {
        let light = Light { kind: light, color: DVec3::ONE, attenuation: gonio_light::Attenuation::NONE };
        let mut frame = gonio_scene::Scene::default().frame(0.0);
        (frame.shadows, frame.width, frame.height, frame.lights) = (true, 640, 480, vec![light]);
        (frame.bounds_min, frame.bounds_max) = (DVec3::new(-2.0, -1.0, -3.0), DVec3::new(2.0, 1.0, 1.0));
        frame.camera = gonio_scene::Camera::looking_along(DVec3::Z * 4.0, DVec3::NEG_Z, DVec3::Y, 0.2, 0.1, 100.0);
        ShadowPlan::new(&frame, 8192, at_vertices)
    }

    /// Every point of the box that a light reaches is in one of its maps, between its planes, where the matrix puts it.
    #[test]
    fn maps_cover_all_that_a_light_lights() {
        let position = DVec3::new(0.5, 3.0, 0.2);
        let axis = DVec3::new(0.1, -1.0, 0.05);
        let spot = |outer_rad| LightKind::Spot { position, axis, inner_rad: 0.1, outer_rad };
        let lights = [
            (LightKind::Directional { direction: axis }, 1),
            (spot(0.6), 1),
            (spot(1.5), 6),
            (LightKind::Point { position }, 6),
            (LightKind::Point { position: DVec3::new(0.1, 0.2, -0.3) }, 6),
        ];
        for (kind, count) in lights {
            let plan = plan(kind, true);
            assert_eq!(plan.rows, [[0, count]]);
            for i in 0..343 {
                let share = DVec3::new(f64::from(i % 7), f64::from(i / 7 % 7), f64::from(i / 49)) / 6.0;
                let p = DVec3::new(-2.0, -1.0, -3.0) + share * DVec3::new(4.0, 2.0, 4.0);
                let spot = Light { kind, color: DVec3::ONE, attenuation: gonio_light::Attenuation::NONE };
                if spot.incident(p, DVec3::Y).is_none_or(|incident| incident.spot <= 0.0) {
                    continue;
                }
                let within = plan.maps.iter().flatten().any(|map| {
                    let clip = map.clip_from_world() * p.extend(1.0);
                    clip.w > 0.0 && clip.truncate().abs().max_element() <= clip.w
                });
                assert!(within, "{kind:?}: {p} is in no map");
            }
        }
    }

    /// A small part of the box is seen, and the map of what is seen has finer texels.
    #[test]
    fn a_map_is_as_fine_as_the_picture_needs() {
        let kind = LightKind::Directional { direction: DVec3::NEG_Y };
        let width = |plan: &ShadowPlan| plan.maps[0].map_or(DVec2::ZERO, |map| map.window[1] - map.window[0]);
        let (whole, part) = (plan(kind, true), plan(kind, false));
        assert!(width(&whole).min_element() > 4.0, "{}", width(&whole));
        assert!(width(&part).min_element() < 2.5, "{}", width(&part));
        assert_eq!(whole.side, 2048);
    }
}
