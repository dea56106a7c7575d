//! A program drawn in all situations at once.

use super::surface::{Numbered, Surface};
use super::{CUBEMAP_UNIT, Shape, Situation, WHITE_UNIT, numbers_of_array, samplers, sky, unit};
use crate::roles::{Bindings, Bound, Kind, Role};
use gonio_gl::{Gl, GlError};
use gonio_render::user_program::{FloatTexture, NOT_DRAWN, Stream, StreamMesh, TileTarget, UserProgram};
use std::cell::RefCell;
use std::collections::HashMap;
use std::rc::Rc;

/// Pixels along a side of a situation's picture: enough for a hundred triangles, and cheap on a driver without a GPU.
pub const TILE: u32 = 32;

/// All situations' pictures, one after the other, linear RGBA; [`NOT_DRAWN`] where nothing is.
#[derive(Clone, Debug, PartialEq)]
pub struct Sheet {
    /// `TILE * TILE` a situation, the bottom row first.
    pub pixels: Vec<[f32; 4]>,
}

impl Sheet {
    /// One situation's pixels.
    pub fn tile(&self, index: usize) -> &[[f32; 4]] {
        let size = (TILE * TILE) as usize;
        self.pixels.get(index * size..(index + 1) * size).unwrap_or_default()
    }

    /// Whether something was drawn at a pixel.
    pub fn is_drawn(pixel: &[f32; 4]) -> bool {
        // Not `!=`: a pixel may hold NaN.
        pixel[0] != NOT_DRAWN[0] || pixel[3] != NOT_DRAWN[3]
    }
}

/// Everything that programs are drawn with, but for themselves.
pub struct Stage {
    pub(super) gl: Gl,
    meshes: Vec<StreamMesh>,
    pub(super) numbered: Numbered,
    cubemap: FloatTexture,
    white: FloatTexture,
    pub(super) target: TileTarget,
    situations: Vec<Situation>,
    /// By what is written to `gl_Position`.
    pub(super) surfaces: RefCell<HashMap<String, Rc<Surface>>>,
}

impl Stage {
    /// For these situations.
    pub fn new(gl: &Gl, situations: Vec<Situation>) -> Result<Self, GlError> {
        let mesh = |shape: Shape| {
            let mesh = shape.mesh();
            let stream = |name, components, numbers| Stream { name, components, numbers };
            StreamMesh::new(
                gl,
                &[
                    stream("position", 3, &mesh.positions),
                    stream("normal", 3, &mesh.normals),
                    stream("tex_coord", 2, &mesh.tex_coords),
                    stream("color", 3, &mesh.colors),
                ],
                &mesh.indices,
                &format!("{shape:?}"),
            )
        };
        Ok(Stage {
            gl: gl.clone(),
            numbered: Numbered::new(gl)?,
            meshes: Shape::ALL.into_iter().map(mesh).collect::<Result<_, _>>()?,
            cubemap: FloatTexture::cube(gl, sky::SIDE, &sky::faces(), "surroundings")?,
            white: FloatTexture::flat(gl, [1, 1], &[[1.0; 4]], "white")?,
            target: TileTarget::new(gl, TILE, situations.len())?,
            situations,
            surfaces: RefCell::default(),
        })
    }

    /// Where programs are drawn.
    pub fn situations(&self) -> &[Situation] {
        &self.situations
    }

    /// Works out once what a program's attributes and uniforms hold in every situation, each changed by `change` beforehand.
    pub fn cast(&self, program: &UserProgram, bindings: &Bindings, change: impl Fn(&mut Situation)) -> Cast {
        let feed = bindings
            .bound
            .iter()
            .filter(|bound| bound.declared.kind == Kind::Attribute)
            .filter_map(|bound| Some((program.attribute_location(&bound.declared.name)?, stream_of(bound.role)?)))
            .collect();
        let uniforms: Vec<(usize, &Bound)> = bindings
            .bound
            .iter()
            .filter(|bound| bound.declared.kind == Kind::Uniform)
            .filter_map(|bound| Some((program.uniform_index(&bound.declared.name)?, bound)))
            .collect();
        let samplers = samplers(program, bindings);
        let values = self
            .situations
            .iter()
            .map(|situation| {
                let mut situation = situation.clone();
                change(&mut situation);
                let value = |&(index, bound): &(usize, &Bound)| {
                    let glsl_type = bound.declared.glsl_type.as_str();
                    let values = match unit(glsl_type) {
                        Some(_) => None,
                        None => numbers_of_array(bound.role, glsl_type, bound.declared.array, &situation),
                    };
                    Some((index, values?))
                };
                samplers.iter().cloned().chain(uniforms.iter().filter_map(value)).collect()
            })
            .collect();
        Cast { feed, values }
    }

    /// What OpenGL complained of since this was last asked. In a browser the question costs as much as many a draw.
    pub fn complaint(&self) -> Result<(), GlError> {
        self.target.error().map_or(Ok(()), Err)
    }

    /// Draws a program in the first `count` situations; `fixed` are uniforms that hold the same in all. Whether OpenGL complained
    /// of it is to be asked: [`Stage::complaint`].
    pub fn draw(
        &self,
        program: &UserProgram,
        cast: &Cast,
        fixed: &[(String, Vec<f32>)],
        count: usize,
    ) -> Result<Sheet, GlError> {
        self.target.begin();
        self.cubemap.bind(CUBEMAP_UNIT);
        self.white.bind(WHITE_UNIT);
        program.bind();
        for (name, values) in fixed {
            program.set(name, values);
        }
        for (tile, (situation, values)) in self.situations.iter().zip(&cast.values).take(count).enumerate() {
            for (index, values) in values {
                program.set_index(*index, values);
            }
            self.target.select(tile);
            self.meshes[situation.shape.index()].draw(program, &cast.feed);
        }
        Ok(Sheet { pixels: self.target.read(count) })
    }
}

/// What a program's attributes and uniforms hold in every situation.
#[derive(Clone, Debug, PartialEq)]
pub struct Cast {
    /// Locations of attributes, and the streams that feed them.
    feed: Vec<(u32, usize)>,
    /// Of each situation: numbers of uniforms, and what they hold.
    values: Vec<Vec<(usize, Vec<f32>)>>,
}

/// Which stream of a mesh an attribute reads.
pub fn stream_of(role: Role) -> Option<usize> {
    match role {
        Role::Position => Some(0),
        Role::Normal => Some(1),
        Role::TexCoord => Some(2),
        Role::Color => Some(3),
        _ => None,
    }
}
