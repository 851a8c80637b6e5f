//! How far the bodies of links go on a way from where they are at its middle: of each as much as is asked, first by the speeds of the
//! joints that carry it, then by how it moves at the middle.

use super::ball_on_way::BallOnWay;
use super::balls::Balls;
use super::carried::Carried;
use super::kinematics::Kinematics;
use super::linear_motion::{LinearMotion, extent};
use super::link_rounding::LinkRounding;
use super::pair_rates::PairRates;
use super::way::{Way, WayKind};
use crate::pose::Vec3;
use crate::query::{Scene, Target};

/// The links at the middle of a way.
pub(super) struct LinksOnWay<'a, 'k> {
    way: &'a Way<'a>,
    scene: &'a Scene<'a>,
    /// [`Way::rounding`] of it.
    pub rounding: Vec<f64>,
    pub rates: PairRates<'a>,
    /// The kinematics there; none in a box of configurations.
    middle: Option<&'k mut Kinematics<'a>>,
    /// By the links' numbers; `None` for those without a body of their own.
    links: Vec<Option<LinkOnWay<'a>>>,
}

/// A link's own body.
struct LinkOnWay<'a> {
    body: Carried<'a, usize>,
    /// Its centre in the world.
    center: Vec3,
    /// Bounds how far it goes, by the speeds of joints.
    by_speed: f64,
    closer: Option<CloserLook<'a>>,
}

/// What a closer look at a body has shown.
struct CloserLook<'a> {
    /// Bounds how far it goes.
    shift: f64,
    /// `None` in a box of configurations, and where a custom joint moves it.
    ball: Option<BallOnWay<'a>>,
}

impl<'a, 'k> LinksOnWay<'a, 'k> {
    /// In the scene at the middle of a way.
    pub fn new(
        way: &'a Way<'a>,
        scene: &'a Scene<'a>,
        rates: PairRates<'a>,
        middle: Option<&'k mut Kinematics<'a>>,
    ) -> Self {
        let share = share(way);
        let look_at = |link: usize| {
            let (body, pose) = scene.link(link)?;
            let (speed, radius) = (rates.speeds.of(link), body.radius_from_origin());
            let by_speed =
                share * speed.at_radius(radius) + speed.rounding.of_places(radius, share);
            let is_known = !speed.is_unknown && !by_speed.is_nan();
            Some(LinkOnWay {
                body: Carried {
                    body,
                    link,
                    pose: None,
                    number: link,
                },
                center: pose.transform_point(body.center()),
                by_speed: if is_known { by_speed } else { f64::INFINITY },
                closer: None,
            })
        };
        Self {
            way,
            scene,
            rounding: way.rounding(),
            links: (0..scene.poses().len()).map(look_at).collect(),
            rates,
            middle,
        }
    }

    /// The largest part of a motion that lies between the middle and any other time.
    pub fn share(&self) -> f64 {
        share(self.way)
    }

    /// Bounds how far a link's own body goes in the world, by the speeds of joints; 0 where it has none.
    pub fn shift_by_speed(&self, link: usize) -> f64 {
        self.links[link].as_ref().map_or(0.0, |link| link.by_speed)
    }

    /// Bounds how far a link's own body goes, as closely as is worth the work where all that is as near is looked for: a body that goes
    /// no farther than it reaches has few others near that it does not come to.
    pub fn shift_for_search(&mut self, link: usize) -> f64 {
        match &self.links[link] {
            None => 0.0,
            Some(found) if found.by_speed <= found.body.body.radius() => found.by_speed,
            Some(_) => self.shift(link),
        }
    }

    /// Bounds how far a link's own body goes in the world; 0 where it has none.
    pub fn shift(&mut self, link: usize) -> f64 {
        self.look_closer(link).map_or(0.0, |closer| closer.shift)
    }

    /// Whether the balls around two links' bodies stay farther apart than a distance all the while. How both move in the world says so of
    /// most pairs, before any pair has rates of its own.
    pub fn stay_apart(&mut self, [r, s]: [usize; 2], threshold: f64) -> bool {
        let [Some(a), Some(b)] = [&self.links[r], &self.links[s]] else {
            return false;
        };
        let balls = Balls::of_bodies([a.body.body, b.body.body], threshold);
        let stay_apart = |shifts: f64| balls.stay_apart(&(a.center - b.center), |_, _| shifts, 0.0);
        if stay_apart(a.by_speed + b.by_speed) {
            return true;
        }
        if !stay_apart(0.0) {
            return false;
        }
        self.look_closer(r);
        self.look_closer(s);
        let balls = [r, s].map(|link| {
            let closer = self.links[link].as_ref()?.closer.as_ref()?;
            closer.ball.as_ref()
        });
        matches!(balls, [Some(a), Some(b)] if a.stays_apart_from(b, threshold))
    }

    /// Looks closer at a link's own body, unless that is done.
    fn look_closer(&mut self, link: usize) -> Option<&CloserLook<'a>> {
        let found = self.links[link].as_ref()?;
        if found.closer.is_none() {
            let (body, by_speed) = (found.body, found.by_speed);
            let closer = self.closer_look(&body, by_speed);
            self.links[link].as_mut()?.closer = Some(closer);
        }
        self.links[link].as_ref()?.closer.as_ref()
    }

    fn closer_look(&mut self, body: &Carried<'a, usize>, by_speed: f64) -> CloserLook<'a> {
        let (share, radius) = (self.share(), body.body.radius());
        let rates = self.rates.of_body(body);
        let ball = rates.zip(self.middle.as_deref_mut());
        let ball = ball.map(|(rates, middle)| BallOnWay::new(body, middle, &rates));
        let by_rates = rates.map(|rates| {
            let moved = share * (rates.turn[0] * radius + rates.origin[0]);
            let moved = (ball.as_ref()).map_or(moved, |ball| moved.min(ball.moved()));
            moved + rates.rounding.of_places(radius, share)
        });
        // Unknown where a custom joint moves the body, or bounds overflow.
        let shift = by_rates.filter(|shift| !shift.is_nan());
        let shift = shift.unwrap_or_else(|| {
            let LinearMotion { q, v, cobject, .. } = self.way.line;
            let moved = share * cobject.space().motion_bound(body.link, q, v);
            moved + self.rounding_of_link(body.link, body.body.radius_from_origin())
        });
        CloserLook {
            shift: shift.min(by_speed),
            ball,
        }
    }

    /// What rounding may move a body that a link carries, at the middle and at any other time together; no point of the body is farther
    /// than `radius` from the link's origin.
    pub fn rounding_of_link(&self, link: usize, radius: f64) -> f64 {
        let rounding = LinkRounding {
            motion: &self.way.line,
            speeds: &self.rates.speeds,
            poses: self.scene.poses(),
            of_coordinates: &self.rounding,
            share: self.share(),
        };
        rounding.within(link, radius)
    }

    /// Bounds the change of the distance of a pair to which not only a link's own body belongs, by the motion of its bodies.
    pub fn shift_of_pair(&self, target: &Target) -> f64 {
        let (r_link, s_link) = target.links();
        let links = [Some(r_link), s_link];
        let roundings = links
            .into_iter()
            .zip(target.sides)
            .filter_map(|(link, placed)| {
                let link = link?;
                Some(self.rounding_of_link(link, extent(self.scene, link, placed)))
            });
        roundings.sum::<f64>() + self.share() * self.way.line.rate(self.scene, target)
    }
}

fn share(way: &Way) -> f64 {
    match way.kind {
        WayKind::Line | WayKind::Curve { .. } | WayKind::Stated(_) => 0.5,
        WayKind::Box { .. } => 1.0,
    }
}
