//! The known word that a mistyped one is nearest to.

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

/// How many letters must be put in, taken out or replaced (Levenshtein 1966).
fn distance(a: &str, b: &str) -> usize {
    let b: Vec<char> = b.chars().collect();
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, x) in a.chars().enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for (j, y) in b.iter().enumerate() {
            let replaced = diagonal + usize::from(x != *y);
            diagonal = row[j + 1];
            row[j + 1] = replaced.min(diagonal + 1).min(row[j] + 1);
        }
    }
    row[b.len()]
}
