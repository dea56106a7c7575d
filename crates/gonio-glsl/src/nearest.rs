//! Finds the known name that a misspelt one probably means.

/// Returns the nearest of `names`, if it is near enough: at most a third of the letters may differ, whatever their case.
pub(crate) fn nearest<'n>(misspelt: &str, names: impl Iterator<Item = &'n str>) -> Option<&'n str> {
    let length = misspelt.chars().count();
    // One letter is not a misspelling of another, and comparing long names takes the product of their lengths.
    if length < 2 || misspelt.len() >= 100 {
        return None;
    }
    let most = (length / 3).min(2);
    let lower = misspelt.to_lowercase();
    names
        .filter(|name| *name != misspelt && name.len() < 100)
        .map(|name| (strsim::osa_distance(&lower, &name.to_lowercase()), name))
        .filter(|(edits, _)| *edits <= most)
        .min_by_key(|(edits, name)| (*edits, strsim::osa_distance(misspelt, name)))
        .map(|(_, name)| name)
}

#[cfg(test)]
mod tests {
    use super::nearest;

    #[test]
    fn the_misspelt_find_their_name() {
        let names = ["normalize", "position", "light_pos", "v_normal"];
        for (expected, found) in [
            ("normalise", Some("normalize")),
            ("postion", Some("position")),
            ("Position", Some("position")),
            ("lightPos", Some("light_pos")),
            ("v_noraml", Some("v_normal")),
            ("shininess", None),
        ] {
            assert_eq!(nearest(expected, names.into_iter()), found, "{expected}");
        }
    }
}
