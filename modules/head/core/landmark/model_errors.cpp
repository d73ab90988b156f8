#include "head/core/landmark/model_errors.hpp"

#include <algorithm>
#include <cmath>

namespace priamos::head {
namespace {

/// What an edge, and the breadth, may be off in each look alike.
constexpr double kEdgeAlike_m = 0.0007, kBreadthAlike_m = 0.001;

double TopOf(const LandmarkModel& model) {
  double top_m = 0;
  for (const LandmarkEdge& edge : model.edges) top_m = std::max({top_m, edge.from.z(), edge.to.z()});
  return top_m;
}

/// Edges of one depth have its error in common.
void AddDepth(const LandmarkModel& model, double depth_m2, Eigen::MatrixXd& covariance) {
  for (std::size_t i = 0; i < model.edges.size(); ++i)
    for (std::size_t j = 0; j < model.edges.size(); ++j)
      if (AreInOneDepth(model.edges[i], model.edges[j]))
        covariance(static_cast<Eigen::Index>(3 * i), static_cast<Eigen::Index>(3 * j)) += depth_m2;
}

}  // namespace

bool AreInOneDepth(const LandmarkEdge& a, const LandmarkEdge& b) {
  constexpr double kSame_m = 0.001;
  const auto is_fixed = [](const LandmarkEdge& edge) {
    return !edge.IsMovable() && std::abs(edge.from.x() - edge.to.x()) < kSame_m;
  };
  return is_fixed(a) && is_fixed(b) && std::abs(a.from.x() - b.from.x()) < kSame_m;
}

Breadth ModelErrors::breadth() const {
  const Eigen::Index last = mean.size() - 1;
  return {mean(last), std::sqrt(std::max(covariance(last, last), 0.0))};
}

EdgeShifts ShiftsOf(const LandmarkModel& model, const Eigen::VectorXd& errors) {
  const double broader_m = errors(errors.size() - 1);
  EdgeShifts shifts;
  shifts.reserve(model.edges.size());
  for (Eigen::Index i = 0; i + 1 < errors.size(); i += 3) {
    const LandmarkEdge& edge = model.edges[static_cast<std::size_t>(i / 3)];
    shifts.emplace_back(errors.segment<3>(i) + Eigen::Vector3d(0, broader_m * edge.ByBreadth(), 0));
  }
  return shifts;
}

LandmarkModel Shifted(LandmarkModel model, const EdgeShifts& shifts) {
  for (std::size_t i = 0; i < shifts.size(); ++i) {
    model.edges[i].from += shifts[i];
    model.edges[i].to += shifts[i];
  }
  return model;
}

Eigen::MatrixXd ModelVariance::CovarianceFor(const LandmarkModel& model) const {
  const Eigen::Index size = ModelErrors::SizeFor(model);
  Eigen::VectorXd variance(size), by_height = Eigen::VectorXd::Zero(size);
  const double top_m = TopOf(model);
  for (std::size_t i = 0; i < model.edges.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(3 * i);
    variance.segment<3>(at).setConstant(model.edges[i].IsMovable() ? movable_m2 : edge_m2);
    if (top_m > 0 && model.edges[i].IsLevel()) by_height(at + 2) = model.edges[i].from.z() / top_m;
  }
  variance.tail<1>()(0) = breadth_m2;
  Eigen::MatrixXd covariance = height_m2 * by_height * by_height.transpose();
  covariance.diagonal() += variance;
  if (depth_m2 > 0) AddDepth(model, depth_m2, covariance);
  return covariance;
}

ModelErrors CarriedOver(ModelErrors errors, const LandmarkModel& model, const ModelVariance& before) {
  const Eigen::VectorXd prior = before.CovarianceFor(model).diagonal();
  // Nothing is less known than before any look.
  Eigen::VectorXd alike = Eigen::VectorXd::Constant(prior.size(), kEdgeAlike_m * kEdgeAlike_m);
  alike.tail<1>()(0) = kBreadthAlike_m * kBreadthAlike_m;
  errors.covariance.diagonal() += alike.cwiseMin((prior - errors.covariance.diagonal()).cwiseMax(0));
  for (std::size_t i = 0; i < model.edges.size(); ++i) {
    if (!model.edges[i].IsMovable()) continue;
    const auto at = static_cast<Eigen::Index>(3 * i);
    errors.mean.segment<3>(at).setZero();
    errors.covariance.middleRows<3>(at).setZero();
    errors.covariance.middleCols<3>(at).setZero();
    errors.covariance.diagonal().segment<3>(at) = prior.segment<3>(at);
  }
  return errors;
}

ModelErrors OnlyBreadth(const ModelErrors& errors, const LandmarkModel& model, const ModelVariance& before) {
  if (errors.mean.size() != ModelErrors::SizeFor(model)) return {};
  ModelErrors only{Eigen::VectorXd::Zero(errors.mean.size()), before.CovarianceFor(model)};
  const Breadth breadth = errors.breadth();
  only.mean.tail<1>()(0) = breadth.broader_m;
  only.covariance.bottomRightCorner<1, 1>()(0, 0) = breadth.sigma_m * breadth.sigma_m;
  return only;
}

}  // namespace priamos::head
