//! Scalar types of PLY, and reading them from bytes.

/// A scalar type. The format defines the first eight; some programs also write 64-bit integers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Scalar {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    I64,
    U64,
    F32,
    F64,
}

impl Scalar {
    /// Parses either name of a type.
    pub(super) fn named(name: &str) -> Option<Scalar> {
        Some(match name {
            "char" | "int8" => Scalar::I8,
            "uchar" | "uint8" => Scalar::U8,
            "short" | "int16" => Scalar::I16,
            "ushort" | "uint16" => Scalar::U16,
            "int" | "int32" => Scalar::I32,
            "uint" | "uint32" => Scalar::U32,
            "long" | "int64" => Scalar::I64,
            "ulong" | "uint64" => Scalar::U64,
            "float" | "float32" => Scalar::F32,
            "double" | "float64" => Scalar::F64,
            _ => return None,
        })
    }

    /// Returns the size in bytes in binary files.
    pub(super) fn size(self) -> usize {
        match self {
            Scalar::I8 | Scalar::U8 => 1,
            Scalar::I16 | Scalar::U16 => 2,
            Scalar::I32 | Scalar::U32 | Scalar::F32 => 4,
            Scalar::I64 | Scalar::U64 | Scalar::F64 => 8,
        }
    }

    /// Returns the value that represents 1 in colours.
    pub(super) fn white(self) -> f64 {
        match self {
            Scalar::I8 => f64::from(i8::MAX),
            Scalar::U8 => f64::from(u8::MAX),
            Scalar::I16 => f64::from(i16::MAX),
            Scalar::U16 => f64::from(u16::MAX),
            Scalar::F32 | Scalar::F64 => 1.0,
            // Programs that write colours as `int` mean bytes.
            Scalar::I32 | Scalar::U32 | Scalar::I64 | Scalar::U64 => f64::from(u8::MAX),
        }
    }

    /// Reads the number at the start of `bytes`, which has at least [`Self::size`] of them. Exact, except for 64-bit
    /// integers beyond 2^53.
    #[inline]
    pub(super) fn read(self, bytes: &[u8], is_big_endian: bool) -> Option<f64> {
        macro_rules! number {
            ($type:ty) => {{
                let bytes = *bytes.first_chunk()?;
                (if is_big_endian { <$type>::from_be_bytes(bytes) } else { <$type>::from_le_bytes(bytes) }) as f64
            }};
        }
        Some(match self {
            Scalar::I8 => number!(i8),
            Scalar::U8 => number!(u8),
            Scalar::I16 => number!(i16),
            Scalar::U16 => number!(u16),
            Scalar::I32 => number!(i32),
            Scalar::U32 => number!(u32),
            Scalar::I64 => number!(i64),
            Scalar::U64 => number!(u64),
            Scalar::F32 => number!(f32),
            Scalar::F64 => number!(f64),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_byte_orders() {
        let bytes = [0x41, 0x20, 0, 0, 0, 0, 0, 0];
        assert_eq!(Scalar::F32.read(&bytes, true), Some(10.0));
        assert_eq!(Scalar::F32.read(&[0, 0, 0x20, 0x41], false), Some(10.0));
        assert_eq!(Scalar::I16.read(&[0xFF, 0xFE], true), Some(-2.0));
        assert_eq!(Scalar::I16.read(&[0xFE, 0xFF], false), Some(-2.0));
        assert_eq!(Scalar::U32.read(&[0xFF; 4], false), Some(4_294_967_295.0));
        assert_eq!(Scalar::F64.read(&[0x40, 0x59, 0, 0, 0, 0, 0, 0], true), Some(100.0));
        assert_eq!(Scalar::U32.read(&[0; 3], false), None);
    }
}
