//! Wide nodes in the byte format of body files.

use super::wide_node::WideNode;

/// The bytes of a node in a file.
pub const NODE_BYTES: usize = 252;

impl WideNode {
    /// The node as bytes: the fields in order, little-endian, without the lowest primitive.
    pub fn to_bytes(&self) -> [u8; NODE_BYTES] {
        let mut bytes = [0; NODE_BYTES];
        let mut at = 0;
        let mut put = |field: &[u8]| {
            bytes[at..at + field.len()].copy_from_slice(field);
            at += field.len();
        };
        let signed = self.axes.as_flattened().iter().chain(&self.center);
        signed.flatten().for_each(|x| put(&x.to_le_bytes()));
        let halves = self.half.as_flattened();
        halves.iter().for_each(|x| put(&x.to_le_bytes()));
        self.children.iter().for_each(|x| put(&x.to_le_bytes()));
        self.frame.iter().for_each(|x| put(&x.to_le_bytes()));
        put(&self.sizes);
        put(&self.count.to_le_bytes());
        bytes
    }

    /// Reads a node; `None` if its frame or count is out of range.
    pub fn from_bytes(bytes: &[u8; NODE_BYTES]) -> Option<Self> {
        let mut rest = &bytes[..];
        fn take<const N: usize>(rest: &mut &[u8]) -> [u8; N] {
            let (taken, after) = rest.split_first_chunk().expect("the sizes of the fields");
            *rest = after;
            *taken
        }
        let mut signed = || std::array::from_fn(|_| i16::from_le_bytes(take(&mut rest)));
        let axes = [0, 1].map(|_| [0, 1, 2].map(|_| signed()));
        let center = [0, 1, 2].map(|_| signed());
        let half = [0, 1, 2].map(|_| std::array::from_fn(|_| u16::from_le_bytes(take(&mut rest))));
        let children = std::array::from_fn(|_| u32::from_le_bytes(take(&mut rest)));
        let mut number = || f32::from_le_bytes(take(&mut rest));
        let node = Self {
            axes,
            center,
            half,
            children,
            frame: [number(), number(), number(), number()],
            sizes: take(&mut rest),
            count: u32::from_le_bytes(take(&mut rest)),
            lowest: 0,
        };
        let sensible = |x: f32| x.abs() <= 4.0;
        let is_sound = node.frame.into_iter().all(sensible);
        (is_sound && (1..=8).contains(&node.count)).then_some(node)
    }
}
