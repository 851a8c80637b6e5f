//! Maps of sets that prove nothing, that fail, and that take their time.

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Duration;

use cstk::cobject::{CObject, Class, PureOptions, PureShape};
use cstk::error::{Error, ErrorKind, Result};
use cstk::map::{Map, MapAxis, MapKind, MapOptions, MapValues};

use crate::compound::slider;
use helpers::pure::classified;

/// How often a set is asked, when it begins to fail, and how long it takes.
struct Asked {
    count: AtomicUsize,
    most: usize,
    sleep: Duration,
}

impl Asked {
    fn new(most: usize, sleep: Duration) -> Arc<Self> {
        Arc::new(Self {
            count: AtomicUsize::new(0),
            most,
            sleep,
        })
    }

    fn questions(&self) -> usize {
        self.count.load(Ordering::Relaxed)
    }

    /// Inside from 0 on.
    fn classify(&self, q: &[f64]) -> Result<Class> {
        std::thread::sleep(self.sleep);
        if self.count.fetch_add(1, Ordering::Relaxed) >= self.most {
            return Err(Error::new(ErrorKind::Callback, "enough"));
        }
        Ok(match q[0] {
            above if above >= 0.0 => Class::Inside,
            _ => Class::Outside,
        })
    }
}

/// In a union with a set that can be proved.
fn union_with(asked: &Arc<Asked>) -> CObject {
    let space = slider();
    let asked = asked.clone();
    let answered = classified(&space, move |q| asked.classify(q));
    let limits = CObject::pure(space, PureShape::BeyondLimits, PureOptions::default());
    CObject::union(&[answered, Arc::new(limits.unwrap())]).unwrap()
}

fn axis(cells: usize) -> [MapAxis; 1] {
    [MapAxis::new(0, [-1.0, 1.0], cells)]
}

fn on_threads(threads: u32) -> MapOptions {
    MapOptions {
        threads,
        ..MapOptions::default()
    }
}

#[test]
fn classes_need_no_proof() {
    for cells in [100, 10_000] {
        let asked = &Asked::new(usize::MAX, Duration::ZERO);
        let build = |options: &MapOptions| {
            let nothing = &mut |_| Ok(());
            Map::build(&union_with(asked), &[0.0], &axis(cells), options, nothing)
        };
        let map = build(&on_threads(2)).unwrap();
        let expected = (0..cells).map(|cell| if cell < cells / 2 { 0 } else { 2 });
        assert_eq!(map.values(), &MapValues::Classes(expected.collect()));
        // What is proved needs a speed.
        let proved = MapOptions {
            kind: MapKind::Cells,
            ..on_threads(2)
        };
        let refused = build(&proved).unwrap_err();
        assert_eq!(refused.kind, ErrorKind::Unsupported);
        assert!(!refused.message.contains("item"), "{refused}");
    }
}

#[test]
fn the_first_failure_ends_a_map() {
    for threads in [1, 4] {
        let asked = &Asked::new(1000, Duration::ZERO);
        let nothing = &mut |_| Ok(());
        let built = Map::build(
            &union_with(asked),
            &[0.0],
            &axis(400_000),
            &on_threads(threads),
            nothing,
        );
        let failed = built.unwrap_err();
        assert_eq!(failed.kind, ErrorKind::Callback);
        assert!(failed.message.starts_with("cell ["), "{failed}");
        let questions = asked.questions();
        assert!(questions < 1000 + 100 * threads as usize, "{questions}");
    }
}

/// Tiles of some 40 cells that take 200 milliseconds each: progress is told within them, and ends them.
#[test]
fn progress_is_told_within_tiles() {
    for threads in [1, 2] {
        let asked = &Asked::new(usize::MAX, Duration::from_millis(5));
        let mut heard = Vec::new();
        let mut hear = |fraction: f64| {
            heard.push(fraction);
            match heard.len() {
                3.. => Err(Error::new(ErrorKind::Cancelled, "enough")),
                _ => Ok(()),
            }
        };
        let options = on_threads(threads);
        let cobject = union_with(asked);
        let built = Map::build(&cobject, &[0.0], &axis(10_000), &options, &mut hear);
        assert_eq!(built.unwrap_err().kind, ErrorKind::Cancelled);
        assert!(
            heard.is_sorted() && heard[2] > 0.0 && heard[2] < 0.01,
            "{heard:?}"
        );
        let questions = asked.questions();
        assert!(questions < 200, "{questions}");
    }
}

#[test]
fn refusals_of_maps_are_short_and_name_their_culprit() {
    let asked = &Asked::new(usize::MAX, Duration::ZERO);
    let refused = |axis: MapAxis| {
        let nothing = &mut |_| Ok(());
        let built = Map::build(&union_with(asked), &[0.0], &[axis], &on_threads(1), nothing);
        built.unwrap_err()
    };
    let cells = usize::MAX / 4;
    let large = refused(MapAxis::new(0, [-1.0, 1.0], cells));
    assert_eq!(large.kind, ErrorKind::OutOfMemory);
    let expected = format!("a map of {cells} cells takes {cells} bytes: ");
    assert!(large.message.starts_with(&expected), "{large}");
    let far = refused(MapAxis::new(0, [-1.0, 1e300], 3));
    assert!(far.message.ends_with("is too large: 1e300"), "{far}");
}
