//! Skins: the position of a mesh in its bind pose.

use super::accessor::Accessor;
use super::buffer::Buffers;
use super::json::JsonRef;
use super::node::PlacedNodes;
use crate::ReadError;
use glam::DMat4;

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
