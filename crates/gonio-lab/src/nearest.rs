//! The known word that a mistyped one is nearest to.

/// The word most like a given one, however little.
pub(crate) fn most_like<'a>(given: &str, words: impl Iterator<Item = &'a str>) -> Option<&'a str> {
    words.min_by_key(|word| distance(&given.to_lowercase(), &word.to_lowercase()))
}

/// The nearest of `known`, where it is near enough to have been meant: at most a third of the letters differ.
pub(crate) fn nearest<'a>(word: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
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

/// How many letters must be put in, left out, changed or swapped with their neighbour.
pub(crate) fn distance(a: &str, b: &str) -> usize {
    // Longer than any name a person writes: do not spend the square of it.
    let a: Vec<char> = a.chars().take(100).collect();
    let b: Vec<char> = b.chars().take(100).collect();
    let mut rows = vec![vec![0; b.len() + 1]; a.len() + 1];
    for i in 0..=a.len() {
        for j in 0..=b.len() {
            rows[i][j] = if i == 0 || j == 0 {
                i + j
            } else {
                let changed = rows[i - 1][j - 1] + usize::from(a[i - 1] != b[j - 1]);
                let mut least = changed.min(rows[i - 1][j] + 1).min(rows[i][j - 1] + 1);
                if i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] {
                    least = least.min(rows[i - 2][j - 2] + 1);
                }
                least
            };
        }
    }
    rows[a.len()][b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distances_count_slips() {
        for (a, b, slips) in
            [("light", "light", 0), ("ligth", "light", 1), ("lght", "light", 1), ("", "abc", 3), ("ab", "cd", 2)]
        {
            assert_eq!(distance(a, b), slips);
        }
    }

    #[test]
    fn what_is_too_far_away_was_not_meant() {
        assert_eq!(nearest("TEXTURE2D", ["TEXTURE2", "TEXTURE_2D"]), Some("TEXTURE_2D"));
        assert_eq!(nearest("shininess", ["position", "normal"]), None);
        assert_eq!(most_like("shininess", ["position", "shine"].into_iter()), Some("shine"));
    }
}
