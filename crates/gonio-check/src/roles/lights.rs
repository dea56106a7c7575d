//! The lights that names refer to, and their indices.

use super::role::Role;
use std::collections::BTreeMap;

/// The light that a name refers to.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Place {
    /// The name of the struct without numbers; empty for a variable outside of structs.
    pub(super) group: String,
    /// The index in brackets, from 0.
    pub(super) bracket: Option<u32>,
    /// A number in the name; students count from 0 or from 1.
    pub(super) number: Option<u32>,
    /// Whether the name refers to another light: `otherLightPos`.
    pub(super) is_another: bool,
}

type RoleKind = std::mem::Discriminant<Role>;

/// Returns the indices of lights, from 0 without gaps. If two structs have the same quantity, each has its own
/// lights.
pub(super) fn light_indices(lights: &[(Role, Place)]) -> Vec<u32> {
    let mut sizes: BTreeMap<&str, usize> = BTreeMap::new();
    for (_, place) in lights {
        *sizes.entry(&place.group).or_default() += 1;
    }
    let mut groups: BTreeMap<(u8, std::cmp::Reverse<usize>, &str), Vec<usize>> = BTreeMap::new();
    for (at, (_, place)) in lights.iter().enumerate() {
        let lower = place.group.to_lowercase();
        // This order does not depend on the driver, unlike that of OpenGL's list.
        let rank = if lower.contains("dir") {
            1
        } else if lower.contains("spot") {
            2
        } else {
            0
        };
        // The light with the most variables is the first one: a position beside it may belong to another.
        let count = sizes.get(place.group.as_str()).copied().unwrap_or(0);
        groups.entry((rank, std::cmp::Reverse(count), &place.group)).or_default().push(at);
    }
    let mut indices = vec![0; lights.len()];
    let mut taken: Vec<(RoleKind, u32)> = Vec::new();
    for members in groups.values() {
        within_group(lights, members, &mut indices);
        if groups.len() > 1 && is_only_a_place(lights, members) {
            continue;
        }
        let kind = |at: usize| std::mem::discriminant(&lights[at].0);
        let collides = members.iter().any(|&at| taken.contains(&(kind(at), indices[at])));
        let offset = if collides { taken.iter().map(|(_, index)| index + 1).max().unwrap_or(0) } else { 0 };
        for &at in members {
            indices[at] = indices[at].saturating_add(offset);
        }
        // A student has a handful of lights; the order of a hostile shader's thousands does not matter.
        taken.extend(members.iter().take(1000).map(|&at| (kind(at), indices[at])));
    }
    indices
}

/// Whether a group is only a position beside a struct, and not named as another light's. It belongs to the struct:
/// `lightPos` in the vertex shader and `light.position` in the fragment shader.
fn is_only_a_place(lights: &[(Role, Place)], members: &[usize]) -> bool {
    members.iter().all(|&at| {
        let (role, place) = &lights[at];
        let stands_alone = place.group.is_empty() && place.number.is_none() && !place.is_another;
        stands_alone && matches!(role, Role::LightPos(_) | Role::LightPosInView(_))
    })
}

fn within_group(lights: &[(Role, Place)], members: &[usize], indices: &mut [u32]) {
    let numbered = |at: usize| lights[at].1.number.filter(|_| lights[at].1.bracket.is_none());
    let mut numbers: Vec<u32> = members.iter().filter_map(|&at| numbered(at)).collect();
    numbers.sort_unstable();
    numbers.dedup();
    // `lightPos` beside `lightPos2` is the first light.
    let mut bare: Vec<RoleKind> = Vec::new();
    for &at in members {
        if lights[at].1.number.is_none() && lights[at].1.bracket.is_none() {
            bare.push(std::mem::discriminant(&lights[at].0));
        }
    }
    let shift =
        members.iter().any(|&at| numbered(at).is_some() && bare.contains(&std::mem::discriminant(&lights[at].0)));
    for &at in members {
        let rank = numbered(at).and_then(|number| numbers.binary_search(&number).ok());
        indices[at] = match (lights[at].1.bracket, rank) {
            (Some(bracket), _) => bracket,
            (None, Some(rank)) => u32::try_from(rank).unwrap_or(u32::MAX).saturating_add(u32::from(shift)),
            (None, None) => 0,
        };
    }
}
