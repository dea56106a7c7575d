//! Walks over the nodes of the scene and reads what they place.

use super::document::{Document, name_of};
use super::geometry::{self, Geometry};
use super::light;
use super::local::{self, Builder, Cuts, LocalMesh, lacks_tex_coords};
use super::materials::{Binding, Materials, part_name};
use super::source::DataSources;
use super::xml::Element;
use crate::text::quote;
use crate::{ModelCamera, ModelLight, ReadError, Severity};
use glam::{DMat3, DMat4, DVec3};
use std::collections::{BTreeMap, HashMap, HashSet};
use std::rc::Rc;

/// Most elements that are visited, each as often as it is instantiated: nodes that instantiate nodes that instantiate
/// nodes could take forever.
const MOST_STEPS: u64 = 2_000_000;

/// Most controllers that may deform each other's output.
const MOST_CONTROLLERS: usize = 8;

pub(super) struct NodeWalker<'d, 't> {
    document: &'d Document<'t>,
    model_from_file: DMat4,
    meter: f64,
    sources: DataSources,
    pub(super) materials: Materials,
    pub(super) builder: Builder<'t>,
    pub(super) lights: Vec<ModelLight>,
    pub(super) cameras: Vec<ModelCamera>,
    /// Numbers of primitives in geometries, and of placed geometries.
    pub(super) counts: BTreeMap<&'static str, u64>,
    pub(super) placed: u64,
    pub(super) cuts: Cuts,
    steps: u64,
    // Results by element.
    matrices: HashMap<u32, DMat4>,
    bindings: HashMap<u32, Rc<Binding>>,
    geometries: HashMap<u32, Rc<Geometry>>,
    meshes: HashMap<(u32, Vec<Option<u32>>), Rc<LocalMesh>>,
}

enum Step<'t> {
    /// A node at `model_from_parent`.
    Enter(Element<'t>, DMat4),
    /// The end of a node.
    Leave(u32),
}

impl<'d, 't> NodeWalker<'d, 't> {
    pub(super) fn new(document: &'d Document<'t>) -> Result<Self, ReadError> {
        let (model_from_file, meter) = model_from_file(document)?;
        Ok(NodeWalker {
            document,
            model_from_file,
            meter,
            sources: DataSources::default(),
            materials: Materials::read(document)?,
            builder: Builder::new(document.limits),
            lights: Vec::new(),
            cameras: Vec::new(),
            counts: BTreeMap::new(),
            placed: 0,
            cuts: Cuts::default(),
            steps: 0,
            matrices: HashMap::new(),
            bindings: HashMap::new(),
            geometries: HashMap::new(),
            meshes: HashMap::new(),
        })
    }

    /// Walks over the scene that the document refers to, or else the first one, or else places every geometry once.
    pub(super) fn walk(&mut self) -> Result<(), ReadError> {
        let root = self.document.tree.root();
        let instance = root.path(&["scene", "instance_visual_scene"]);
        let named = instance.and_then(|instance| self.document.target(instance, "url", &["visual_scene"]));
        let first = || root.all("library_visual_scenes").find_map(|library| library.child("visual_scene"));
        let scene = named.or_else(first);
        match (scene, named) {
            (Some(scene), None) => {
                let name = quote(name_of(scene).as_bytes());
                self.document.warn(
                    scene.at(),
                    format!("the scene that the document refers to does not exist: drawing the first one, {name}"),
                );
            }
            (None, _) => {
                self.document.warn(root.at(), "there is no scene: drawing every geometry untransformed");
                for library in root.all("library_geometries") {
                    for geometry in library.all("geometry") {
                        self.place(geometry, geometry, None, self.model_from_file)?;
                    }
                }
            }
            _ => {}
        }
        let Some(scene) = scene else { return Ok(()) };
        let mut steps: Vec<Step<'t>> = Vec::new();
        let nodes: Vec<Element<'t>> = scene.all("node").collect();
        steps.extend(nodes.into_iter().rev().map(|node| Step::Enter(node, self.model_from_file)));
        let mut inside: HashSet<u32> = HashSet::new();
        while let Some(step) = steps.pop() {
            match step {
                Step::Leave(index) => drop(inside.remove(&index)),
                Step::Enter(node, model_from_parent) => {
                    if !inside.insert(node.index) {
                        let name = quote(name_of(node).as_bytes());
                        return Err(self
                            .document
                            .error(node.at(), format!("the node {name} contains itself by way of an instance_node")));
                    }
                    steps.push(Step::Leave(node.index));
                    self.node(node, model_from_parent, &mut steps)?;
                }
            }
        }
        Ok(())
    }

    fn spend(&mut self, steps: usize, at: usize) -> Result<(), ReadError> {
        self.steps = self.steps.saturating_add(steps as u64);
        if self.steps <= MOST_STEPS {
            return Ok(());
        }
        let message = format!(
            "nodes are instantiated so often that more than {MOST_STEPS} elements would be visited, which is the limit"
        );
        Err(self.document.error(at, message))
    }

    fn node(
        &mut self,
        node: Element<'t>,
        model_from_parent: DMat4,
        steps: &mut Vec<Step<'t>>,
    ) -> Result<(), ReadError> {
        let parent_from_node = match self.matrices.get(&node.index) {
            Some(known) => *known,
            None => {
                let matrix = parent_from_node(self.document, node)?;
                self.matrices.insert(node.index, matrix);
                matrix
            }
        };
        let model_from_node = model_from_parent * parent_from_node;
        let first = steps.len();
        let mut children = 1;
        for child in node.children() {
            children += 1;
            match child.name() {
                "node" => steps.push(Step::Enter(child, model_from_node)),
                "instance_node" => {
                    if let Some(target) = self.document.target(child, "url", &["node"]) {
                        steps.push(Step::Enter(target, model_from_node));
                    }
                }
                "instance_geometry" => {
                    if let Some(geometry) = self.document.target(child, "url", &["geometry"]) {
                        self.place(geometry, child, Some(node), model_from_node)?;
                    }
                }
                "instance_controller" => self.controller(child, node, model_from_node)?,
                "instance_light" => {
                    if let Some(element) = self.document.target(child, "url", &["light"]) {
                        self.lights.extend(light::light(self.document, element, model_from_node, self.meter)?);
                    }
                }
                "instance_camera" => {
                    if let Some(element) = self.document.target(child, "url", &["camera"]) {
                        self.cameras.extend(light::camera(self.document, element, model_from_node, self.meter)?);
                    }
                }
                _ => {}
            }
        }
        // The first child is on top of the stack.
        steps[first..].reverse();
        self.spend(children, node.at())
    }

    /// Draws a deformed geometry as it was bound: a skin where its bind_shape_matrix puts it, in the space of the
    /// scene; a morph in its base shape.
    fn controller(
        &mut self,
        instance: Element<'t>,
        node: Element<'t>,
        model_from_node: DMat4,
    ) -> Result<(), ReadError> {
        let Some(mut here) = self.document.target(instance, "url", &["controller"]) else { return Ok(()) };
        let mut model_from_local = model_from_node;
        let mut bind_shape = None;
        for _ in 0..MOST_CONTROLLERS {
            if here.name() == "geometry" {
                if let Some(matrix) = bind_shape {
                    model_from_local = self.model_from_file * matrix;
                }
                return self.place(here, instance, Some(node), model_from_local);
            }
            let kind = here.child("skin").or_else(|| here.child("morph"));
            let Some(kind) = kind else {
                self.document.warn(here.at(), "this controller is neither a skin nor a morph: it is left out");
                return Ok(());
            };
            self.document.add("geometries drawn undeformed", Severity::Warning, here.at(), || {
                let name = quote(name_of(here).as_bytes());
                match kind.name() {
                    "skin" => format!("{name} is a skin: drawn in its bind pose"),
                    _ => format!("{name} is a morph: drawn in its base shape"),
                }
            });
            if let Some(matrix) = kind.child("bind_shape_matrix")
                && bind_shape.is_none()
            {
                bind_shape = Some(DMat4::from_cols_array(&self.document.exactly::<16>(matrix)?).transpose());
            }
            match self.document.target(kind, "source", &["geometry", "controller"]) {
                Some(next) => here = next,
                None => return Ok(()),
            }
        }
        let message = format!("controllers are nested more than {MOST_CONTROLLERS} deep, perhaps in a cycle");
        Err(self.document.error(instance.at(), message))
    }

    /// Draws a geometry; `instance` binds its materials.
    fn place(
        &mut self,
        element: Element<'t>,
        instance: Element<'t>,
        node: Option<Element<'t>>,
        model_from_local: DMat4,
    ) -> Result<(), ReadError> {
        let geometry = match self.geometries.get(&element.index) {
            Some(known) => known.clone(),
            None => {
                let read = geometry::read(self.document, &mut self.sources, element, &mut self.counts)?;
                let read = Rc::new(read);
                self.geometries.insert(element.index, read.clone());
                read
            }
        };
        self.placed += 1;
        self.spend(1 + geometry.primitives.len(), instance.at())?;
        let binding = match self.bindings.get(&instance.index) {
            Some(known) => known.clone(),
            None => {
                let binding = Rc::new(self.materials.bind(self.document, instance));
                self.bindings.insert(instance.index, binding.clone());
                binding
            }
        };
        let set = |primitive: &geometry::Primitive| self.materials.set(&binding, primitive.symbol.as_deref());
        let key = (element.index, geometry.primitives.iter().map(set).collect::<Vec<_>>());
        let mesh = match self.meshes.get(&key) {
            Some(known) => known.clone(),
            None => {
                let mesh = Rc::new(local::build(self.document, &geometry, &key.1, &mut self.cuts)?);
                self.meshes.insert(key, mesh.clone());
                mesh
            }
        };
        let name = part_name(node, &geometry.name);
        let (document, materials) = (self.document, &mut self.materials);
        let mut material_of = |index: usize| {
            let primitive = geometry.primitives.get(index);
            let (symbol, at) = primitive.map_or((None, element.at()), |p| (p.symbol.as_deref(), p.at));
            let material = materials.index(document, &binding, symbol, at, instance);
            if materials.has_textures(material) && lacks_tex_coords(&geometry, index) {
                document.add("polygons that lack texture coordinates", Severity::Warning, at, || {
                    format!(
                        "polygons of {} have no texture coordinates, but their material has a texture",
                        quote(name.as_bytes())
                    )
                });
            }
            material
        };
        self.builder.place(document, &mesh, model_from_local, &name, instance.at(), &mut material_of)
    }
}

/// Returns `parent_from_file`, which converts to Y up and metres, and the length of the file's unit in metres.
pub(super) fn model_from_file(document: &Document<'_>) -> Result<(DMat4, f64), ReadError> {
    let Some(asset) = document.tree.root().child("asset") else { return Ok((DMat4::IDENTITY, 1.0)) };
    let mut meter = 1.0;
    if let Some(unit) = asset.child("unit")
        && let Some(written) = unit.attribute("meter")
    {
        match written.trim().parse::<f64>() {
            Ok(value) if value.is_finite() && value > 0.0 => meter = value,
            _ => {
                let written = quote(written.as_bytes());
                document.warn(unit.at(), format!("invalid unit length {written}: using 1 metre"));
            }
        }
    }
    let axes = match asset.child("up_axis") {
        None => DMat3::IDENTITY,
        Some(axis) => match axis.text().as_ref() {
            "Y_UP" => DMat3::IDENTITY,
            "Z_UP" => DMat3::from_cols(DVec3::X, DVec3::NEG_Z, DVec3::Y),
            "X_UP" => DMat3::from_cols(DVec3::Y, DVec3::NEG_X, DVec3::Z),
            other => {
                let message = format!("up_axis is {}, not X_UP, Y_UP or Z_UP: using Y_UP", quote(other.as_bytes()));
                document.warn(axis.at(), message);
                DMat3::IDENTITY
            }
        },
    };
    Ok((DMat4::from_mat3(axes) * DMat4::from_scale(DVec3::splat(meter)), meter))
}

/// `parent_from_node`: all transforms of a node, in the order of the file.
pub(super) fn parent_from_node(document: &Document<'_>, node: Element<'_>) -> Result<DMat4, ReadError> {
    let mut matrix = DMat4::IDENTITY;
    for child in node.children() {
        matrix *= match child.name() {
            // Written row by row.
            "matrix" => DMat4::from_cols_array(&document.exactly::<16>(child)?).transpose(),
            "translate" => DMat4::from_translation(DVec3::from(document.exactly::<3>(child)?)),
            "scale" => DMat4::from_scale(DVec3::from(document.exactly::<3>(child)?)),
            "rotate" => {
                let [x, y, z, degrees] = document.exactly::<4>(child)?;
                match DVec3::new(x, y, z).try_normalize() {
                    Some(axis) => DMat4::from_axis_angle(axis, degrees.to_radians()),
                    None => DMat4::IDENTITY,
                }
            }
            "lookat" => look_at(document, child)?,
            "skew" => skew(document.exactly::<7>(child)?),
            _ => continue,
        };
    }
    Ok(matrix)
}

/// Eye, interest, up; the node looks along its -z.
fn look_at(document: &Document<'_>, element: Element<'_>) -> Result<DMat4, ReadError> {
    let v = document.exactly::<9>(element)?;
    let [eye, interest, up] =
        [DVec3::new(v[0], v[1], v[2]), DVec3::new(v[3], v[4], v[5]), DVec3::new(v[6], v[7], v[8])];
    let back = (eye - interest).try_normalize();
    let right = back.and_then(|back| up.cross(back).try_normalize());
    let (Some(back), Some(right)) = (back, right) else {
        document.warn(
            element.at(),
            "this lookat has no direction, or looks along its up vector: only its position is used",
        );
        return Ok(DMat4::from_translation(eye));
    };
    Ok(DMat4::from_translation(eye) * DMat4::from_mat3(DMat3::from_cols(right, back.cross(right), back)))
}

/// Angle in degrees, the axis that turns, the axis along which points move; as RenderMan defines it: the first axis is
/// turned towards the second by the angle.
fn skew(v: [f64; 7]) -> DMat4 {
    let turned = DVec3::new(v[1], v[2], v[3]).normalize_or_zero();
    let along = DVec3::new(v[4], v[5], v[6]).normalize_or_zero();
    // The component of `turned` orthogonal to `along` is the height above the fixed plane.
    let height = turned - turned.dot(along) * along;
    let Some(height) = height.try_normalize() else { return DMat4::IDENTITY };
    let shear = v[0].to_radians().tan();
    // p + along * shear * (height . p), column by column.
    let column = |axis: DVec3| axis + along * shear * height.dot(axis);
    DMat4::from_mat3(DMat3::from_cols(column(DVec3::X), column(DVec3::Y), column(DVec3::Z)))
}
