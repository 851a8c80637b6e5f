//! Decompresses LZF, which PCD files use. No crate is used: the one there was is no longer kept up by its author.

/// Literal runs have a first byte below this.
const LITERALS: u8 = 1 << 5;

/// No byte of the data stands for more: a reference of 3 bytes repeats at most 264.
const MAX_GROWTH: usize = 88;

/// Decompresses exactly `length` bytes; `None` if the data do not hold so many, or more. Asks for memory only for
/// what the data can hold.
pub fn decompress(mut data: &[u8], length: usize) -> Option<Vec<u8>> {
    if length / MAX_GROWTH > data.len() {
        return None;
    }
    let mut out = Vec::new();
    out.try_reserve_exact(length).ok()?;
    while let Some((&control, rest)) = data.split_first() {
        if control < LITERALS {
            let (literals, rest) = rest.split_at_checked(usize::from(control) + 1)?;
            out.extend_from_slice(literals);
            data = rest;
        } else {
            let (count, offset, rest) = reference(control, rest)?;
            let from = out.len().checked_sub(offset)?;
            // Byte by byte, as a reference may overlap what it appends.
            for i in from..from + count {
                out.push(out[i]);
            }
            data = rest;
        }
        if out.len() > length {
            return None;
        }
    }
    (out.len() == length).then_some(out)
}

/// How many bytes are repeated, and from how far back.
fn reference(control: u8, rest: &[u8]) -> Option<(usize, usize, &[u8])> {
    let (more, rest) = match control >> 5 {
        7 => {
            let (&more, rest) = rest.split_first()?;
            (usize::from(more), rest)
        }
        _ => (0, rest),
    };
    let (&low, rest) = rest.split_first()?;
    let count = usize::from(control >> 5) + 2 + more;
    let offset = (usize::from(control & 31) << 8) + usize::from(low) + 1;
    Some((count, offset, rest))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn literals_and_references_by_hand() {
        // Two literals, then 9 bytes from two back, then 3 from one back.
        let data = [1, b'a', b'b', 7 << 5, 0, 1, 1 << 5, 0];
        assert_eq!(decompress(&data, 14).unwrap(), b"abababababaaaa");
        for wrong in [0, 13, 15] {
            assert_eq!(decompress(&data, wrong), None);
        }
        for cut in 1..data.len() {
            assert_eq!(decompress(&data[..cut], 14), None);
        }
        assert_eq!(decompress(&[1 << 5, 0], 3), None);
    }
}
