//! The types of the numbers in PLY and PCD files.

/// The type of a stored number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NumberType {
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

/// The order of a number's bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ByteOrder {
    Little,
    Big,
}

impl NumberType {
    /// The number of bytes.
    pub fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::I64 | Self::U64 | Self::F64 => 8,
        }
    }

    /// The number in the first bytes, which must be as many as [`NumberType::size`] at least. 64-bit integers are rounded.
    pub fn read(self, bytes: &[u8], order: ByteOrder) -> f64 {
        match self {
            Self::I8 => f64::from(bytes[0] as i8),
            Self::U8 => f64::from(bytes[0]),
            Self::I16 => f64::from(u16::from_le_bytes(little(bytes, order)) as i16),
            Self::U16 => f64::from(u16::from_le_bytes(little(bytes, order))),
            Self::I32 => f64::from(u32::from_le_bytes(little(bytes, order)) as i32),
            Self::U32 => f64::from(u32::from_le_bytes(little(bytes, order))),
            Self::I64 => u64::from_le_bytes(little(bytes, order)) as i64 as f64,
            Self::U64 => u64::from_le_bytes(little(bytes, order)) as f64,
            Self::F32 => f64::from(f32::from_le_bytes(little(bytes, order))),
            Self::F64 => f64::from_le_bytes(little(bytes, order)),
        }
    }
}

/// The first bytes, the lowest first.
fn little<const N: usize>(bytes: &[u8], order: ByteOrder) -> [u8; N] {
    let mut first: [u8; N] = std::array::from_fn(|i| bytes[i]);
    if order == ByteOrder::Big {
        first.reverse();
    }
    first
}
