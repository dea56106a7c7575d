//! The known word that a mistyped one is nearest to.

/// The word most like a given one, however little.
pub fn most_like<'a>(given: &str, words: impl Iterator<Item = &'a str>) -> Option<&'a str> {
    words.min_by_key(|word| distance(&given.to_lowercase(), &word.to_lowercase()))
}

/// The nearest of `known`, where it is near enough to have been meant: at most a third of the letters differ.
pub fn nearest<'a>(word: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    // Longer words are nobody's typing error, and comparing them takes long.
    if word.chars().count() > 48 {
        return None;
    }
    let lower = word.to_lowercase();
    let away = |candidate: &str| {
        let candidate = candidate.to_lowercase();
        // `TEXTURE2D` is `TEXTURE_2D` rather than `TEXTURE2`.
        let without = distance(&lower.replace('_', ""), &candidate.replace('_', ""));
        (without, distance(&lower, &candidate))
    };
    let found = known.into_iter().map(|candidate| (away(candidate), candidate)).min()?;
    let allowed = (word.chars().count().max(found.1.len()) / 3).max(1);
    (found.0.0 <= allowed).then_some(found.1)
}

/// The number of insertions, deletions, substitutions and swaps of neighbours between two words, of which the first 100
/// characters count.
pub fn distance(a: &str, b: &str) -> usize {
    // Longer than any name a person writes: do not spend the square of it.
    let cut = |word: &str| word.chars().take(100).collect::<String>();
    strsim::osa_distance(&cut(a), &cut(b))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_too_far_away_was_not_meant() {
        assert_eq!(nearest("TEXTURE2D", ["TEXTURE2", "TEXTURE_2D"]), Some("TEXTURE_2D"));
        assert_eq!(nearest("shininess", ["position", "normal"]), None);
        assert_eq!(most_like("shininess", ["position", "shine"].into_iter()), Some("shine"));
    }
}
