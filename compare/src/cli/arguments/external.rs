//! Images of others: the same words for a new study and for a finished one.

use super::values;
use crate::Error;
use crate::study::sweep::External;

/// Images that somebody else made.
#[derive(clap::Args, Debug)]
#[command(next_help_heading = "Images of others")]
pub(in crate::cli) struct ExternalArgs {
    /// Judge this image too, [SCENE:]NAME=FILE: linear (.exr, .hdr) or display-encoded (.png)
    #[arg(long = "image", value_name = "NAME=FILE", value_parser = values::parameter)]
    images: Vec<(String, String)>,
    /// Milliseconds of its frame, [SCENE:]NAME=MS, as its maker measured them
    #[arg(long = "time", value_name = "NAME=MS", value_parser = time, requires = "images")]
    times: Vec<(String, f64)>,
    /// What it was made on, [SCENE:]NAME=TEXT
    #[arg(long = "made-on", value_name = "NAME=TEXT", value_parser = values::parameter,
        requires = "images")]
    made_on: Vec<(String, String)>,
}

impl ExternalArgs {
    /// True if there is none.
    pub(in crate::cli) fn is_empty(&self) -> bool {
        self.images.is_empty()
    }

    /// The images with what is told of them.
    pub(in crate::cli) fn list(&self) -> Result<Vec<External>, Error> {
        let image = |name: &str| self.images.iter().any(|(image, _)| image == name);
        let told = self.times.iter().map(|(name, _)| name);
        let mut told = told.chain(self.made_on.iter().map(|(name, _)| name));
        if let Some(name) = told.find(|name| !image(name)) {
            return Err(Error::Usage(format!("{name} has no image; add --image {name}=FILE")));
        }
        let one = |(full, path): &(String, String)| {
            let (scene, name) = match full.split_once(':') {
                Some((scene, name)) => (Some(scene.to_owned()), name.to_owned()),
                None => (None, full.clone()),
            };
            let time = self.times.iter().find(|(name, _)| name == full);
            let made_on = self.made_on.iter().find(|(name, _)| name == full);
            External {
                name,
                scene,
                image: path.into(),
                milliseconds: time.map(|(_, ms)| *ms),
                adapter: made_on.map(|(_, text)| text.clone()).unwrap_or_default(),
            }
        };
        Ok(self.images.iter().map(one).collect())
    }
}

fn time(text: &str) -> Result<(String, f64), String> {
    let (name, time) = values::parameter(text)?;
    let ms = time.parse::<f64>().ok().filter(|ms| ms.is_finite() && *ms > 0.0);
    ms.map(|ms| (name, ms)).ok_or_else(|| format!("\"{time}\" is no number of milliseconds"))
}
