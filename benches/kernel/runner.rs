//! A library with one way to use it.

/// One way to answer all queries of a row: seconds of the pass, and the answers.
pub struct Runner<'a> {
    pub library: &'static str,
    pub variant: String,
    pub run: Box<dyn FnMut() -> Option<(f64, Vec<f64>)> + 'a>,
    pub seconds: Vec<f64>,
}

impl<'a> Runner<'a> {
    pub fn new(
        library: &'static str,
        variant: impl Into<String>,
        run: impl FnMut() -> Option<(f64, Vec<f64>)> + 'a,
    ) -> Self {
        Self {
            library,
            variant: variant.into(),
            run: Box::new(run),
            seconds: Vec::new(),
        }
    }

    /// The median, in seconds a pass.
    pub fn median(&self) -> f64 {
        let mut seconds = self.seconds.clone();
        seconds.sort_by(f64::total_cmp);
        seconds
            .get(seconds.len() / 2)
            .copied()
            .unwrap_or(f64::INFINITY)
    }
}
