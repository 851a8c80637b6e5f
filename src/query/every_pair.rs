//! All body pairs of an induced set, near or far: what the set asks about, by its definition and without any search.

use super::answer::SSide;
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
        let pairs = match &term.pairs {
            BodyPairs::Links { pairs, .. } => {
                for &[link, s] in pairs {
                    if let (Some(a), Some(b)) = (self.link(link), self.link(s)) {
                        visit(Target {
                            options,
                            ..self.link_pair([link, s], [a, b])
                        })?;
                    }
                }
                return Ok(());
            }
            BodyPairs::Objects(pairs) => pairs,
        };
        let environment = pairs.objects.environment();
        let Some(snapshot) = self.world().snapshot(environment) else {
            return Ok(());
        };
        let links = &pairs.links;
        let space = self.space();
        let own = links.iter().filter_map(|&link| space.bodies().number(link));
        for body in own.chain(self.held_bodies_of(links, environment.serial())) {
            let (r, (placement, _)) = (self.r_side(body), self.r_body(body));
            let chosen = snapshot.objects().filter(|o| pairs.objects.contains(o.id));
            for object in chosen.filter(|object| pairs.admits(r.link, r.attached, object)) {
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
