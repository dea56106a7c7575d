//! A scene's buffers and textures on the GPU.

use crate::body_on_gpu::BodyOnGpu;
use crate::body_tree::BodyTable;
use crate::environment_on_gpu::EnvironmentOnGpu;
use crate::geometry::{Form, Geometry};
use crate::gpu_cache::GpuCache;
use crate::textures;
use glam::{DMat4, Mat3, Vec3};
use gonio_gl::DriverInfo;
use gonio_gl::objects::TextureObject;
use gonio_gl::{Gl, GlError};
use gonio_light::{Optics, Surfaces};
use gonio_mesh::Mesh;
use gonio_scene::scene_file::Shading;
use gonio_scene::{Object, Scene, SceneMaterial};
use std::cell::RefCell;
use std::collections::HashMap;
use std::rc::Rc;
use std::sync::Arc;

/// A scene's buffers and textures on the GPU, shared with other scenes of the same renderer; freed with the last.
pub struct GpuScene {
    pub(crate) objects: Vec<GpuObject>,
    pub(crate) geometries: Vec<MeshGeometry>,
    pub(crate) materials: Vec<SceneMaterial>,
    pub(crate) textures: Vec<Rc<TextureObject>>,
    pub(crate) environment: Option<Rc<EnvironmentOnGpu>>,
    /// Limits of the driver that change the picture.
    pub(crate) notes: Vec<String>,
    /// The meshes, for overlays.
    meshes: Vec<Arc<Mesh>>,
    /// The geometry of overlays, by mesh and form.
    overlays: RefCell<HashMap<(usize, Form), Rc<Geometry>>>,
    /// Bytes of geometry on the GPU.
    pub geometry_bytes: usize,
    /// Triangles of all objects.
    pub triangle_count: usize,
}

/// A mesh in the forms that its objects need.
#[derive(Default)]
pub(crate) struct MeshGeometry {
    pub shared: Option<Rc<Geometry>>,
    pub unshared: Option<Rc<Geometry>>,
}

/// An object with what does not change from frame to frame.
pub(crate) struct GpuObject {
    pub object: Object,
    pub world_from_model: DMat4,
    /// Inverse transpose, scaled to a largest entry of 1: only its directions count.
    pub normal_world_from_model: Mat3,
    /// The transform mirrors, so front faces are clockwise.
    pub mirrored: bool,
    /// Opaque runs of triangles.
    pub opaque: Vec<Run>,
    /// Triangles of transparent parts, for sorting.
    pub transparent: Vec<TransparentTriangle>,
    /// Its interior, if a material is transparent.
    pub body: Option<Rc<BodyOnGpu>>,
}

/// Consecutive triangles with one material.
#[derive(Clone, Debug)]
pub(crate) struct Run {
    pub name: String,
    pub first_triangle: usize,
    pub triangle_count: usize,
    pub material: usize,
}

/// One triangle that lets light through.
#[derive(Clone, Copy)]
pub(crate) struct TransparentTriangle {
    pub triangle: usize,
    pub material: usize,
    pub center_in_world: Vec3,
}

/// Whether a shading draws the unshared form of a mesh.
pub(crate) fn wants_unshared(shading: Shading) -> bool {
    matches!(shading, Shading::Flat | Shading::FlatPerFace)
}

impl GpuScene {
    pub(crate) fn upload(gl: &Gl, scene: &Scene, info: &DriverInfo, cache: &mut GpuCache) -> Result<Self, GlError> {
        let mut geometries: Vec<MeshGeometry> = scene.meshes.iter().map(|_| MeshGeometry::default()).collect();
        for object in &scene.objects {
            let mesh = &scene.meshes[object.mesh];
            let geometry = &mut geometries[object.mesh];
            if wants_unshared(object.shading) {
                if geometry.unshared.is_none() {
                    let make = || Geometry::new(gl, mesh, Form::Unshared, &object.name);
                    geometry.unshared = Some(cache.geometries.get(mesh, Form::Unshared, make)?);
                }
            } else if geometry.shared.is_none() {
                let make = || Geometry::new(gl, mesh, Form::Shared, &object.name);
                geometry.shared = Some(cache.geometries.get(mesh, Form::Shared, make)?);
            }
        }
        let mut texture = |t| cache.textures.get(t, (), || textures::upload(gl, t, info.max_size));
        let textures = scene.textures.iter().map(&mut texture).collect::<Result<Vec<_>, _>>()?;
        let environment = scene.environment.as_ref();
        let upload = |e| EnvironmentOnGpu::upload(gl, e, info.max_cube_size);
        let environment = environment.map(|e| cache.environments.get(e, (), || upload(e))).transpose()?;
        let mut objects: Vec<GpuObject> = scene.objects.iter().map(|o| GpuObject::new(o, scene)).collect();
        let mut notes = Vec::new();
        if let Some(environment) = &environment {
            notes.extend(environment.notes.iter().cloned());
            for object in &mut objects {
                object.add_body(gl, scene, info, cache, &mut notes)?;
            }
        }
        cache.tidy();
        let geometry_bytes = geometries.iter().flat_map(|g| [&g.shared, &g.unshared]).flatten().map(|g| g.bytes).sum();
        let triangle_count = scene.objects.iter().map(|o| scene.meshes[o.mesh].triangle_count()).sum();
        let materials = scene.materials.clone();
        Ok(GpuScene {
            objects,
            geometries,
            materials,
            textures,
            environment,
            notes,
            meshes: scene.meshes.clone(),
            overlays: RefCell::default(),
            geometry_bytes,
            triangle_count,
        })
    }

    /// The geometry of an overlay of an object, created on first use.
    pub(crate) fn overlay_geometry(
        &self,
        gl: &Gl,
        cache: &mut GpuCache,
        object: &GpuObject,
        form: Form,
    ) -> Result<Rc<Geometry>, GlError> {
        let index = object.object.mesh;
        if let Some(made) = self.overlays.borrow().get(&(index, form)) {
            return Ok(made.clone());
        }
        let name = &object.object.name;
        let mesh = self.meshes.get(index).ok_or_else(|| GlError::new(format!("`{name}` has no mesh")))?;
        let made = cache.geometries.get(mesh, form, || Geometry::new(gl, mesh, form, name))?;
        self.overlays.borrow_mut().insert((index, form), made.clone());
        Ok(made)
    }
}

impl GpuObject {
    fn new(object: &Object, scene: &Scene) -> Self {
        let mesh: &Mesh = &scene.meshes[object.mesh];
        let linear = glam::DMat3::from_mat4(object.world_from_model);
        let determinant = linear.determinant();
        let inverse_transpose = if determinant == 0.0 { linear } else { linear.inverse().transpose() };
        let largest = inverse_transpose.to_cols_array().into_iter().fold(0.0, |m: f64, v| m.max(v.abs()));
        let scaled = if largest > 0.0 { inverse_transpose * (1.0 / largest) } else { inverse_transpose };
        let mut opaque: Vec<Run> = Vec::new();
        let mut transparent = Vec::new();
        for part in &object.parts {
            if scene.materials[part.material].is_transparent() {
                for triangle in part.first_triangle..part.first_triangle + part.triangle_count {
                    let [a, b, c] = mesh.triangle_positions(triangle).map(|p| p.as_dvec3());
                    let center = object.world_from_model.transform_point3((a + b + c) / 3.0);
                    transparent.push(TransparentTriangle {
                        triangle,
                        material: part.material,
                        center_in_world: center.as_vec3(),
                    });
                }
                continue;
            }
            match opaque.last_mut() {
                // Parts that differ in name only are one draw.
                Some(run)
                    if run.material == part.material
                        && run.first_triangle + run.triangle_count == part.first_triangle =>
                {
                    run.triangle_count += part.triangle_count;
                }
                _ => opaque.push(Run {
                    name: part.name.clone(),
                    first_triangle: part.first_triangle,
                    triangle_count: part.triangle_count,
                    material: part.material,
                }),
            }
        }
        GpuObject {
            object: object.clone(),
            world_from_model: object.world_from_model,
            normal_world_from_model: scaled.as_mat3(),
            mirrored: determinant < 0.0,
            opaque,
            transparent,
            body: None,
        }
    }

    /// Makes what is seen through both surfaces of the object, where a material asks for it. Where that is more than the
    /// driver's textures hold, the first surface alone counts, and a note says so.
    fn add_body(
        &mut self,
        gl: &Gl,
        scene: &Scene,
        info: &DriverInfo,
        cache: &mut GpuCache,
        notes: &mut Vec<String>,
    ) -> Result<(), GlError> {
        let object = &self.object;
        let wants = |o: &Optics| !o.is_plain() && o.surfaces == Surfaces::Two;
        if !object.parts.iter().any(|part| wants(&scene.materials[part.material].optics)) {
            return Ok(());
        }
        let mesh = &scene.meshes[object.mesh];
        let flat = wants_unshared(object.shading);
        let key = (flat, object.world_from_model.to_cols_array().map(f64::to_bits));
        self.body = cache.bodies.get_if(mesh, key, || {
            let table = BodyTable::new(mesh, object, flat);
            table.map_or(Ok(None), |table| BodyOnGpu::upload(gl, table, &object.name, info.max_size))
        })?;
        if self.body.is_none() && mesh.triangle_count() > 0 {
            notes.push(format!(
                "`{}` is refracted at its first surface only: the driver has no room for the interior of {} triangles",
                object.name,
                mesh.triangle_count()
            ));
        }
        Ok(())
    }
}
