//! Splits names into words, and finds the known word that is nearest to a misspelt one.

/// Splits a name into words in lower case: at characters that are not letters or digits, before capitals, and between
/// letters and digits. `objectVertexShader_2` gives `object vertex shader 2`.
pub fn words_of(name: &str) -> Vec<String> {
    let chars: Vec<char> = name.chars().collect();
    let mut words: Vec<String> = Vec::new();
    let mut open = false;
    for (i, &c) in chars.iter().enumerate() {
        if !c.is_alphanumeric() {
            open = false;
            continue;
        }
        if let Some(previous) = i.checked_sub(1).and_then(|i| chars.get(i)) {
            let next_is_small = chars.get(i + 1).is_some_and(|c| c.is_lowercase());
            open &= !(c.is_uppercase() && (previous.is_lowercase() || previous.is_uppercase() && next_is_small));
            open &= c.is_numeric() == previous.is_numeric();
        }
        match words.last_mut() {
            Some(word) if open => word.extend(c.to_lowercase()),
            _ => words.push(c.to_lowercase().collect()),
        }
        open = true;
    }
    words
}

/// Returns the word that is most similar to `word`, however different it is.
pub fn most_like<'a>(word: &str, words: impl Iterator<Item = &'a str>) -> Option<&'a str> {
    words.min_by_key(|known| distance(&word.to_lowercase(), &known.to_lowercase()))
}

/// Returns the nearest of `known`, if at most a third of the letters differ.
pub fn nearest<'a>(word: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    // Longer words are not typing errors, and comparing them takes long.
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

/// Returns the number of insertions, deletions, substitutions and transpositions between two words, of which the
/// first 100 characters count.
pub fn distance(a: &str, b: &str) -> usize {
    // Real names are shorter, and the comparison takes the product of the lengths.
    let cut = |word: &str| word.chars().take(100).collect::<String>();
    strsim::osa_distance(&cut(a), &cut(b))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_split_into_words() {
        for (name, words) in [
            ("light_pos", "light pos"),
            ("lightPos", "light pos"),
            ("uMVPMatrix", "u mvp matrix"),
            ("itM", "it m"),
            ("MVP", "mvp"),
            ("tex0", "tex 0"),
            ("ex04-Phong.vert", "ex 04 phong vert"),
            ("__", ""),
            ("lumièreÉtat", "lumière état"),
        ] {
            assert_eq!(words_of(name).join(" "), words, "{name}");
        }
    }

    #[test]
    fn distant_words_are_not_suggested() {
        assert_eq!(nearest("TEXTURE2D", ["TEXTURE2", "TEXTURE_2D"]), Some("TEXTURE_2D"));
        assert_eq!(nearest("shininess", ["position", "normal"]), None);
        assert_eq!(most_like("shininess", ["position", "shine"].into_iter()), Some("shine"));
    }
}
