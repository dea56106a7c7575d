//! A stable hash of bytes.

/// A hash of pieces of bytes that is the same on every machine and with every compiler, and depends on where each piece ends
/// (FNV-1a, 64 bits, over each piece's length and bytes: Fowler, Noll, Vo, draft-eastlake-fnv).
pub fn content_hash<'a>(pieces: impl Iterator<Item = &'a [u8]>) -> u64 {
    let mut sum: u64 = 0xcbf2_9ce4_8422_2325;
    let mut take = |bytes: &[u8]| {
        for byte in bytes {
            sum = (sum ^ u64::from(*byte)).wrapping_mul(0x100_0000_01b3);
        }
    };
    for piece in pieces {
        take(&(piece.len() as u64).to_le_bytes());
        take(piece);
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_hash_depends_on_where_a_piece_ends() {
        let of = |pieces: &[&str]| content_hash(pieces.iter().map(|piece| piece.as_bytes()));
        assert_ne!(of(&["ab", "c"]), of(&["a", "bc"]));
        assert_ne!(of(&["ab"]), of(&["ab", ""]));
        // FNV-1a of no bytes is its offset basis: section 5.
        assert_eq!(of(&[]), 0xcbf2_9ce4_8422_2325);
    }
}
