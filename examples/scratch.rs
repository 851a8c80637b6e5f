use cstk::body::*; use cstk::hierarchy::*; use cstk::pose::Vec3; use std::time::Instant;
fn sphere(n: usize)->Mesh{ let rows=((n as f64/4.0).sqrt()) as usize; let cols=2*rows;
 let mut m=Mesh::default();
 for i in 0..=rows { for j in 0..cols { let t=std::f64::consts::PI*(i as f64)/rows as f64; let p=std::f64::consts::TAU*j as f64/cols as f64;
  let r=1.0+0.1*(7.0*t).sin()*(9.0*p).cos()*t.sin()+0.03*(31.0*t).sin()*(27.0*p).sin()*t.sin();
  let (st,ct)= if i==0 {(0.0,1.0)} else if i==rows {(0.0,-1.0)} else {t.sin_cos()};
  m.vertices.push(Vec3::new(r*st*p.cos(), r*st*p.sin(), r*ct)); } }
 for i in 0..rows { for j in 0..cols { let k=(j+1)%cols; let id=|a:usize,b:usize|(a*cols+b) as u32;
  if i>0 {m.face_sizes.push(3); m.indices.extend([id(i,j),id(i+1,j),id(i,k)]);}
  if i+1<rows {m.face_sizes.push(3); m.indices.extend([id(i,k),id(i+1,j),id(i+1,k)]);} } }
 m }
fn spaghetti(n:usize)->Mesh{ let mut m=Mesh::default(); let mut s=1u64; let mut r=||{s=s.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407); (s>>11) as f64/(1u64<<53) as f64};
 for i in 0..n { let c=Vec3::new(r(),r(),r()); let d=Vec3::new(r()-0.5,r()-0.5,r()-0.5).normalize()*0.5; let w=d.cross(&Vec3::new(r(),r(),r())).normalize()*0.001; let b=4*i as u32;
 m.vertices.extend([c-d-w,c+d-w,c+d+w,c-d+w]); m.face_sizes.push(4); m.indices.extend([b,b+1,b+2,b+3]); } m}
fn coincident(n:usize)->Mesh{ let mut m=Mesh::default(); for i in 0..n {let b=4*i as u32; for (x,y) in [(0.,0.),(1.,0.),(1.,1.),(0.,1.)] {m.vertices.push(Vec3::new(x,y,0.0));} m.face_sizes.push(4); m.indices.extend([b,b+1,b+2,b+3]);} m}
fn shells(n:usize)->Mesh{ let mut m=Mesh::default(); for i in 0..n {let b=4*i as u32; let s=1.0+1e-6*i as f64; for (x,y) in [(-1.,-1.),(1.,-1.),(1.,1.),(-1.,1.)] {m.vertices.push(Vec3::new(s*x,s*y,0.0));} m.face_sizes.push(4); m.indices.extend([b,b+1,b+2,b+3]);} m}
fn main(){ let a:Vec<String>=std::env::args().collect(); let n:usize=a[2].parse().unwrap();
 let mesh=match &a[1][..]{"sphere"=>sphere(n),"spaghetti"=>spaghetti(n),"coincident"=>coincident(n),"shells"=>shells(n),_=>panic!()};
 let t=Instant::now(); let mut b=BodyBuilder::new(3).unwrap(); b.add_mesh(&mesh).unwrap(); println!("add {:.3}",t.elapsed().as_secs_f64());
 for g in [Grouping::Hybrid,Grouping::Basic,Grouping::TopDown]{
  if a.len()>3 && !a[3].contains(&format!("{g:?}")) {continue}
  let mut wrapper=WrapperKind::Hull; if a.len()>4 {wrapper=match &a[4][..]{"obb"=>WrapperKind::OrientedBox,"aabb"=>WrapperKind::AlignedBox,"tight"=>WrapperKind::TightSphere,"merged"=>WrapperKind::MergedSphere,_=>WrapperKind::Hull}}
  let o=HierarchyOptions{grouping:g,wrapper,..Default::default()};
  let t=Instant::now(); let mut at40=0.0; let body=b.build(&o,&mut |f|{ if f<=0.4 {at40=t.elapsed().as_secs_f64();} Ok(())}).unwrap(); let s=t.elapsed().as_secs_f64();
  println!("{g:?} n={} depth {} 2log2={:.1} group {:.3} total {:.3} bytes {}MB",body.primitives().len(),body.statistics().depth,2.0*(body.primitives().len() as f64).log2(),at40,s, body.tree().bytes()/1000000);
 }}
