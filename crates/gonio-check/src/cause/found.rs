//! What a search for causes found, and how good that is.

use super::proven_cause::ProvenCause;
use super::target::Agreement;

/// The result of a search.
#[derive(Clone, Debug)]
pub enum Found {
    /// The picture is right.
    Right(Agreement),
    /// Causes that together explain everything wrong; alternatives of a single cause, the best first.
    Causes(Vec<Vec<ProvenCause>>),
    /// Nothing repairs the picture.
    Nothing,
    /// A loop never ends.
    Endless,
}

/// The largest depth that counts against a result that does not say where the errors are.
const MOST_UNROOTED: usize = 8;

impl Found {
    /// Ranks results of several methods: 0 is best.
    #[must_use]
    pub fn rank(&self) -> usize {
        match self {
            Found::Right(_) | Found::Endless => 0,
            Found::Causes(groups) => {
                let is_sound = |group: &Vec<ProvenCause>| group.first().is_some_and(ProvenCause::is_sound);
                let unsound = groups.iter().filter(|group| !is_sound(group)).count();
                // Two errors are more likely than one in a value that is computed from wrong ones.
                let errors = (groups.len() - 1) + 2 * unsound;
                if self.is_rooted() { errors } else { errors + self.deepest_first().clamp(2, MOST_UNROOTED) + 2 }
            }
            Found::Nothing => usize::MAX,
        }
    }

    /// How far the earliest cause is from the program's inputs.
    pub(super) fn depth(&self) -> u32 {
        match self {
            Found::Causes(groups) => groups.iter().flatten().map(|cause| cause.depth).min().unwrap_or(u32::MAX),
            _ => u32::MAX,
        }
    }

    /// How far the best cause that is farthest from the program's inputs is from them: a whole formula is far.
    fn deepest_first(&self) -> usize {
        match self {
            Found::Causes(groups) => {
                groups.iter().filter_map(|group| group.first()).map(|cause| cause.depth as usize).max().unwrap_or(0)
            }
            _ => 0,
        }
    }

    /// How far the best causes are from the program's inputs.
    pub(super) fn depth_of_firsts(&self) -> u32 {
        match self {
            Found::Causes(groups) => groups.iter().filter_map(|group| group.first()).map(|cause| cause.depth).sum(),
            _ => u32::MAX,
        }
    }

    /// Whether each error is a wrong value of the mistake itself, and not one computed from it.
    pub(super) fn is_at_mistakes(&self) -> bool {
        match self {
            Found::Right(_) | Found::Endless => true,
            Found::Causes(groups) => groups.iter().all(|group| group.iter().any(|cause| cause.distance == 0)),
            Found::Nothing => false,
        }
    }

    /// Whether it says where the errors are.
    #[must_use]
    pub fn is_rooted(&self) -> bool {
        match self {
            Found::Right(_) | Found::Endless => true,
            Found::Causes(groups) => groups.iter().all(|group| group.first().is_some_and(ProvenCause::is_root)),
            Found::Nothing => false,
        }
    }
}
