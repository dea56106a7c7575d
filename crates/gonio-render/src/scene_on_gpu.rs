//! A scene's buffers and textures on the GPU, and the cache that scenes share.

use crate::body::{BodyOnGpu, BodyTable};
use crate::environment_on_gpu::EnvironmentOnGpu;
use crate::geometry::{Form, MeshOnGpu};
use crate::shadows_on_gpu::{ContactShadow, ShadowMaps};
use crate::textures;
use glam::{DMat4, Mat3, Vec3};
use gonio_bsdf::MerlTable;
use gonio_gl::objects::TextureObject;
use gonio_gl::{DriverInfo, Gl, GlError};
use gonio_light::{Optics, Surfaces};
use gonio_mesh::Mesh;
use gonio_scene::scene_file::Shading;
use gonio_scene::{LoadedEnvironment, Object, Scene, SceneMaterial, Texture};
use std::cell::RefCell;
use std::collections::HashMap;
use std::hash::Hash;
use std::rc::{Rc, Weak as WeakRc};
use std::sync::{Arc, Weak};

/// A scene's buffers and textures on the GPU, shared with other scenes of the same renderer; freed with the last.
pub struct GpuScene {
    pub(crate) objects: Vec<GpuObject>,
    pub(crate) geometries: Vec<MeshGeometry>,
    pub(crate) materials: Vec<SceneMaterial>,
    pub(crate) textures: Vec<Rc<TextureObject>>,
    /// The measured BRDFs of materials.
    tables: Vec<(Arc<MerlTable>, Rc<TextureObject>)>,
    pub(crate) environment: Option<Rc<EnvironmentOnGpu>>,
    /// Limits of the driver that change the picture.
    pub(crate) notes: Vec<String>,
    /// The meshes, for overlays.
    pub(crate) meshes: Vec<Arc<Mesh>>,
    /// The geometry of overlays, by mesh and form.
    overlays: RefCell<HashMap<(usize, Form), Rc<MeshOnGpu>>>,
    /// The shadow maps, as drawn last.
    pub(crate) shadows: RefCell<Option<Rc<ShadowMaps>>>,
    /// The contact shadow on the ground, as drawn last.
    pub(crate) contact: RefCell<Option<Rc<ContactShadow>>>,
    /// Bytes of geometry on the GPU.
    pub geometry_bytes: usize,
    /// Triangles of all objects.
    pub triangle_count: usize,
}

/// A mesh in the forms that its objects need.
#[derive(Default)]
pub(crate) struct MeshGeometry {
    pub shared: Option<Rc<MeshOnGpu>>,
    pub unshared: Option<Rc<MeshOnGpu>>,
}

/// An object with what does not change from frame to frame.
pub(crate) struct GpuObject {
    pub object: Object,
    pub world_from_model: DMat4,
    /// Inverse transpose, scaled so that its largest entry is 1: only directions matter.
    pub normal_world_from_model: Mat3,
    /// Whether the transform mirrors, so that front faces are clockwise.
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

/// One transparent triangle.
#[derive(Clone, Copy)]
pub(crate) struct TransparentTriangle {
    pub triangle: usize,
    pub material: usize,
    pub center_in_world: Vec3,
}

/// Whether a shading draws the unshared form of a mesh.
pub fn wants_unshared(shading: Shading) -> bool {
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
                    let make = || MeshOnGpu::new(gl, mesh, Form::Unshared, &object.name);
                    geometry.unshared = Some(cache.geometries.get(mesh, Form::Unshared, make)?);
                }
            } else if geometry.shared.is_none() {
                let make = || MeshOnGpu::new(gl, mesh, Form::Shared, &object.name);
                geometry.shared = Some(cache.geometries.get(mesh, Form::Shared, make)?);
            }
        }
        let mut texture = |t| cache.textures.get(t, TextureForm::Decoded, || textures::upload(gl, t, info.max_size));
        let textures = scene.textures.iter().map(&mut texture).collect::<Result<Vec<_>, _>>()?;
        let mut tables: Vec<(Arc<MerlTable>, Rc<TextureObject>)> = Vec::new();
        for table in scene.materials.iter().filter_map(|material| material.brdf.as_ref()?.table.as_ref()) {
            if !tables.iter().any(|(known, _)| Arc::ptr_eq(known, table)) {
                tables.push((table.clone(), cache.tables.get(table, (), || textures::upload_merl(gl, table))?));
            }
        }
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
            tables,
            environment,
            notes,
            meshes: scene.meshes.clone(),
            overlays: RefCell::default(),
            shadows: RefCell::default(),
            contact: RefCell::default(),
            geometry_bytes,
            triangle_count,
        })
    }

    /// The texture of a measured BRDF.
    pub(crate) fn table(&self, table: &Arc<MerlTable>) -> Option<&TextureObject> {
        self.tables.iter().find(|(known, _)| Arc::ptr_eq(known, table)).map(|(_, texture)| texture.as_ref())
    }

    /// The place of one of its objects in the list of all.
    pub(crate) fn index_of(&self, object: &GpuObject) -> usize {
        self.objects.iter().position(|known| std::ptr::eq(known, object)).unwrap_or(0)
    }

    /// The geometry that an object's shading draws.
    pub(crate) fn geometry_of(&self, object: &GpuObject) -> Result<&MeshOnGpu, GlError> {
        let geometries = self.geometries.get(object.object.mesh);
        let flat = wants_unshared(object.object.shading);
        let geometry = geometries.and_then(|g| if flat { g.unshared.as_deref() } else { g.shared.as_deref() });
        geometry.ok_or_else(|| {
            GlError::new(format!("`{}` was not uploaded for {} shading", object.object.name, object.object.shading))
        })
    }

    /// Whether light is summed at the vertices of any object.
    pub(crate) fn is_lit_at_vertices(&self) -> bool {
        self.objects.iter().any(|o| matches!(o.object.shading, Shading::Gouraud | Shading::FlatPerFace))
    }

    /// The geometry of an overlay of an object, created on first use.
    pub(crate) fn overlay_geometry(
        &self,
        gl: &Gl,
        cache: &mut GpuCache,
        object: &GpuObject,
        form: Form,
    ) -> Result<Rc<MeshOnGpu>, GlError> {
        let index = object.object.mesh;
        if let Some(made) = self.overlays.borrow().get(&(index, form)) {
            return Ok(made.clone());
        }
        let name = &object.object.name;
        let mesh = self.meshes.get(index).ok_or_else(|| GlError::new(format!("`{name}` has no mesh")))?;
        let made = cache.geometries.get(mesh, form, || MeshOnGpu::new(gl, mesh, form, name))?;
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

    /// Uploads the body of an object if a material refracts at both surfaces. If it exceeds the driver's textures, only the first
    /// surface refracts, and a note is added.
    fn add_body(
        &mut self,
        gl: &Gl,
        scene: &Scene,
        info: &DriverInfo,
        cache: &mut GpuCache,
        notes: &mut Vec<String>,
    ) -> Result<(), GlError> {
        let object = &self.object;
        let needs_body = |o: &Optics| !o.is_plain() && o.surfaces == Surfaces::Two;
        if !object.parts.iter().any(|part| needs_body(&scene.materials[part.material].optics)) {
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

/// The form of a texture on the GPU.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum TextureForm {
    /// As gonio's own shaders read it.
    Decoded,
    /// The bytes of the file, for a user's shaders.
    Bytes,
}

/// The GPU resources of all scenes.
#[derive(Default)]
pub(crate) struct GpuCache {
    pub geometries: CacheOf<Form, Mesh, MeshOnGpu>,
    pub textures: CacheOf<TextureForm, Texture, TextureObject>,
    pub tables: CacheOf<(), MerlTable, TextureObject>,
    pub environments: CacheOf<(), LoadedEnvironment, EnvironmentOnGpu>,
    /// The key: whether normals are those of triangles, and the bits of the matrix of the object.
    pub bodies: CacheOf<(bool, [u64; 16]), Mesh, BodyOnGpu>,
}

impl GpuCache {
    /// Removes unused entries.
    pub fn tidy(&mut self) {
        self.geometries.tidy();
        self.textures.tidy();
        self.tables.tidy();
        self.environments.tidy();
        self.bodies.tidy();
    }

    /// The number of resources created so far.
    pub fn count_made(&self) -> usize {
        self.geometries.count_made
            + self.textures.count_made
            + self.tables.count_made
            + self.environments.count_made
            + self.bodies.count_made
    }
}

/// GPU resources by the identity of the data and the way in which they were created.
pub(crate) struct CacheOf<How, Source, Made> {
    made: HashMap<(usize, How), (Weak<Source>, WeakRc<Made>)>,
    /// The number created so far.
    count_made: usize,
}

impl<How, Source, Made> Default for CacheOf<How, Source, Made> {
    fn default() -> Self {
        CacheOf { made: HashMap::new(), count_made: 0 }
    }
}

impl<How: Hash + Eq, Source, Made> CacheOf<How, Source, Made> {
    /// The resource that was created from `source` in this way; it is created now if it is missing.
    ///
    /// The address of an `Arc` identifies its data only while it is not reused: a weak reference prevents that without keeping
    /// the data alive.
    pub fn get(
        &mut self,
        source: &Arc<Source>,
        how: How,
        make: impl FnOnce() -> Result<Made, GlError>,
    ) -> Result<Rc<Made>, GlError> {
        let made = self.get_if(source, how, || make().map(Some))?;
        made.ok_or_else(|| GlError::new("what was just made is not there"))
    }

    /// Like [`Self::get`], for resources that cannot always be created.
    pub fn get_if(
        &mut self,
        source: &Arc<Source>,
        how: How,
        make: impl FnOnce() -> Result<Option<Made>, GlError>,
    ) -> Result<Option<Rc<Made>>, GlError> {
        let key = (Arc::as_ptr(source) as usize, how);
        if let Some(made) = self.made.get(&key).and_then(|(_, made)| made.upgrade()) {
            return Ok(Some(made));
        }
        let Some(made) = make()?.map(Rc::new) else { return Ok(None) };
        self.count_made += 1;
        self.made.insert(key, (Arc::downgrade(source), Rc::downgrade(&made)));
        Ok(Some(made))
    }

    fn tidy(&mut self) {
        self.made.retain(|_, (_, made)| made.strong_count() > 0);
    }

    /// The number that scenes use.
    #[cfg(test)]
    pub fn count(&self) -> usize {
        self.made.values().filter(|(_, made)| made.strong_count() > 0).count()
    }
}
