//! All body pairs of an induced set, near or far: what the set asks about, by its definition and without any search.

use super::answer::SSide;
use super::object_offers::{ObjectsTerm, RSide};
use super::scene::Scene;
use super::target::Target;
use crate::cobject::{BodyPairs, Induced};
use crate::error::Result;

impl Scene<'_> {
    /// In the order of the links, then of the s-objects' ids. Bounds are unknown. Fails as [`Scene::checked`] and the visitor do.
    pub fn visit_every_pair<'s>(
        &'s self,
        term: &Induced,
        mut visit: impl FnMut(Target<'s>) -> Result<()>,
    ) -> Result<()> {
        self.check_term(term)?;
        let options = term.options;
        let (links, bodies, objects, exceptions) = match &term.pairs {
            BodyPairs::Links { pairs, .. } => {
                for &[link, s] in pairs {
                    let r = RSide { link, attached: 0 };
                    if let (Some(a), Some(b)) = (self.link(link), self.link(s)) {
                        visit(Target {
                            options,
                            ..self.target(r, SSide::Link(s), [a, b])
                        })?;
                    }
                }
                return Ok(());
            }
            BodyPairs::Objects {
                links,
                bodies,
                objects,
                exceptions,
            } => (links, bodies, objects, exceptions),
        };
        let environment = objects.environment();
        let Some(snapshot) = self.world().snapshot(environment) else {
            return Ok(());
        };
        let term = ObjectsTerm {
            links,
            bodies,
            objects,
            exceptions,
            options: &options,
            number: 0,
            snapshot,
        };
        let space = self.space();
        let own = links.iter().filter_map(|&link| space.bodies().number(link));
        for body in own.chain(self.held_bodies_of(links, environment.serial())) {
            let (r, (placement, _)) = (self.r_side(body), self.r_body(body));
            let chosen = snapshot.objects().filter(|o| objects.contains(o.id));
            for object in chosen.filter(|object| term.admits(r, object)) {
                let mut held = self.held_of(environment.serial()).map(|(_, held)| held);
                let held = held.find(|held| held.object.id == object.id);
                let at = (&*object.body, held.map_or(&object.pose, |held| &held.pose));
                visit(Target {
                    options,
                    s_carrier: held.map(|held| held.attachment.link),
                    ..self.target(r, SSide::Object(object.id), [placement, at])
                })?;
            }
        }
        Ok(())
    }
}
