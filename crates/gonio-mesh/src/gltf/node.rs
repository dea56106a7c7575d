//! The scene: its nodes and their transforms.

use super::accessor::Accessor;
use super::buffer::Buffers;
use super::json::JsonRef;
use crate::diagnostic::Reports;
use crate::{Diagnostic, ReadError, Severity};
use glam::{DMat4, DQuat, DVec3};

/// A node of the scene.
pub(super) struct PlacedNode {
    pub node: usize,
    pub model_from_node: DMat4,
}

pub(super) struct PlacedNodes {
    /// Parents before children, children in order.
    pub placed: Vec<PlacedNode>,
    /// For each node of the file its index in `placed`.
    place_of_node: Vec<usize>,
}

impl PlacedNodes {
    /// Returns a node, if it is in the scene.
    pub fn of_node(&self, node: usize) -> Option<&PlacedNode> {
        let place = self.place_of_node.get(node)?;
        self.placed.get(*place)
    }
}

/// Markers in place of a parent: not visited yet, and no parent.
const NOT_SEEN: usize = usize::MAX;
const ROOT: usize = usize::MAX - 1;

/// Returns the nodes of the default scene (or else of the first one, or else all nodes).
///
/// A node has one parent (glTF 2.0, section 3.5.2); several parents, or a cycle, are an error.
pub(super) fn place(root: JsonRef<'_>, reports: &mut Reports) -> Result<PlacedNodes, ReadError> {
    let nodes = root.count("nodes");
    let mut walk = Walk { root, parent: vec![NOT_SEEN; nodes], stack: Vec::new() };
    match scene(root, reports)? {
        Some(scene) => walk.push_children(scene, "nodes", ROOT, DMat4::IDENTITY)?,
        None => walk.push_roots()?,
    }
    let mut placed = Vec::new();
    let mut place_of_node = vec![usize::MAX; nodes];
    while let Some((node, model_from_parent)) = walk.stack.pop() {
        let Some(at) = root.get("nodes").and_then(|nodes| nodes.item(node)) else { continue };
        let model_from_node = model_from_parent * parent_from_node(at, reports)?;
        walk.push_children(at, "children", node, model_from_node)?;
        place_of_node[node] = placed.len();
        placed.push(PlacedNode { node, model_from_node });
    }
    let outside = nodes - placed.len();
    if outside > 0 {
        reports.push(0, Diagnostic::note(format!("{outside} of {nodes} nodes are not in the scene: left out")));
    }
    Ok(PlacedNodes { placed, place_of_node })
}

/// Returns the scene that is shown.
fn scene<'v>(root: JsonRef<'v>, reports: &mut Reports) -> Result<Option<JsonRef<'v>>, ReadError> {
    let chosen = match root.target(root, "scene", "scenes")? {
        Some((_, scene)) => Some(scene),
        None => root.get("scenes").and_then(|scenes| scenes.item(0)),
    };
    let count = root.count("scenes");
    if let Some(scene) = chosen
        && count > 1
    {
        reports.push(0, Diagnostic::note(format!("contains {count} scenes: {} is shown", scene.title())));
    }
    Ok(chosen)
}

struct Walk<'v> {
    root: JsonRef<'v>,
    /// The parent of each node.
    parent: Vec<usize>,
    /// Nodes to visit, with the transform of their parent.
    stack: Vec<(usize, DMat4)>,
}

impl<'v> Walk<'v> {
    fn push_children(
        &mut self,
        at: JsonRef<'v>,
        key: &'v str,
        above: usize,
        model_from_parent: DMat4,
    ) -> Result<(), ReadError> {
        let first = self.stack.len();
        let Some(list) = at.get(key) else { return Ok(()) };
        for child in at.list(key)? {
            let index = child.as_index()?;
            let Some(parent) = self.parent.get_mut(index) else {
                let nodes = self.parent.len();
                return Err(ReadError::new(format!(
                    "{} = {}, but the file has {nodes} nodes",
                    child.path(),
                    child.quoted()
                )));
            };
            if *parent != NOT_SEEN {
                return Err(self.second_parent(index, above, &list.path()));
            }
            *parent = above;
            self.stack.push((index, model_from_parent));
        }
        // The last one pushed is visited first.
        self.stack[first..].reverse();
        Ok(())
    }

    /// Without a scene: pushes all nodes that are not children.
    fn push_roots(&mut self) -> Result<(), ReadError> {
        let mut is_child = vec![false; self.parent.len()];
        for node in self.root.list("nodes")? {
            for child in node.list("children")? {
                if let Some(is_child) = is_child.get_mut(child.as_index()?) {
                    *is_child = true;
                }
            }
        }
        for (node, _) in is_child.iter().enumerate().rev().filter(|(_, is_child)| !**is_child) {
            self.parent[node] = ROOT;
            self.stack.push((node, DMat4::IDENTITY));
        }
        if self.stack.is_empty() && !is_child.is_empty() {
            let what = "every node is a child of another, so they form a cycle";
            return Err(ReadError::new(format!("nodes: {what}: the file is damaged")));
        }
        Ok(())
    }

    #[cold]
    fn second_parent(&self, node: usize, above: usize, list: &str) -> ReadError {
        let is_above = |mut at: usize| loop {
            match self.parent.get(at) {
                _ if at == node => return true,
                Some(&parent) => at = parent,
                None => return false,
            }
        };
        if is_above(above) {
            return ReadError::new(format!(
                "{list} names node {node}, which is its own ancestor: the nodes form a cycle"
            ));
        }
        let other = match self.parent.get(node) {
            Some(&ROOT) => "a root of the scene".to_owned(),
            Some(parent) => format!("a child of nodes[{parent}]"),
            None => "elsewhere".to_owned(),
        };
        ReadError::new(format!("{list} names node {node}, which is already {other}: a node can have only one parent"))
    }
}

/// Returns the node's own transform: its matrix, or scale, then rotation, then translation.
fn parent_from_node(at: JsonRef<'_>, reports: &mut Reports) -> Result<DMat4, ReadError> {
    let translation = at.numbers("translation")?;
    let rotation = at.numbers::<4>("rotation")?;
    let scale = at.numbers("scale")?;
    if let Some(columns) = at.numbers::<16>("matrix")? {
        if translation.is_some() || rotation.is_some() || scale.is_some() {
            let message = || format!("{} has both a matrix and other transforms: using the matrix", at.title());
            reports.add_without_line("nodes with two transforms", Severity::Warning, message);
        }
        let matrix = DMat4::from_cols_array(&columns);
        if matrix.row(3) != glam::DVec4::W {
            let message = || format!("{}.matrix has a last row other than 0 0 0 1: it is ignored", at.path());
            reports.add_without_line("matrices that are not affine", Severity::Warning, message);
        }
        return Ok(DMat4::from_cols(
            matrix.x_axis.truncate().extend(0.0),
            matrix.y_axis.truncate().extend(0.0),
            matrix.z_axis.truncate().extend(0.0),
            matrix.w_axis.truncate().extend(1.0),
        ));
    }
    let rotation = DQuat::from_array(rotation.unwrap_or([0.0, 0.0, 0.0, 1.0]));
    let length = rotation.length();
    // Exporters write f32s that are of unit length to six digits.
    if (length - 1.0).abs() > 1e-3 {
        let message = || format!("{}.rotation is a quaternion of length {length:.4} instead of 1", at.path());
        reports.add_without_line("rotations that are not of unit length", Severity::Warning, message);
    }
    let rotation = if length > 0.0 && length.is_finite() { rotation / length } else { DQuat::IDENTITY };
    Ok(DMat4::from_scale_rotation_translation(
        DVec3::from(scale.unwrap_or([1.0; 3])),
        rotation,
        DVec3::from(translation.unwrap_or([0.0; 3])),
    ))
}

/// Returns the transform from a bound mesh's own space to the model's, by its first joint: `model_from_joint *
/// joint_from_mesh`, which is the same for every joint in the bind pose. The transform of the mesh's node is ignored
/// (glTF 2.0, section 3.7.3.3). `None` if the skin does not define it.
pub(super) fn model_from_mesh<'v>(
    root: JsonRef<'v>,
    skin: JsonRef<'v>,
    places: &PlacedNodes,
    buffers: &mut Buffers<'v, '_>,
) -> Result<Option<DMat4>, ReadError> {
    let joint = skin.get("joints").and_then(|joints| joints.item(0)).map(JsonRef::as_index).transpose()?;
    let Some(joint) = joint.and_then(|joint| places.of_node(joint)) else { return Ok(None) };
    let joint_from_mesh = match Accessor::open(buffers, root, skin, "inverseBindMatrices", &[16])? {
        Some(matrices) if matrices.count > 0 => {
            let columns = matrices.vectors::<16>(0..1, 0.0);
            columns.first().map_or(DMat4::IDENTITY, |columns| DMat4::from_cols_array(&columns.map(f64::from)))
        }
        _ => DMat4::IDENTITY,
    };
    Ok(Some(joint.model_from_node * joint_from_mesh))
}
